// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad/CADFile.h"

#include "TestClosedMesh.h"
#include "TestFiles.h"
#include "TestParts.h"
#include "base/Bounds.h"
#include "io/cad/ChildProcess.h"
#include "mesh/FeatureEdges.h"

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BezierSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_StepModel.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>

#include <algorithm>
#include <array>
#include <cmath>

namespace
{
constexpr double Inch = 25.4; // mm

TopoDS_Shape box(double x, double y, double z) { return BRepPrimAPI_MakeBox(x, y, z).Shape(); }

/// Writes a file in another process: Open CASCADE prints and leaves memory behind. Returns its path.
template <typename Write>
std::string written(const std::string& path, const Write& write)
{
  const auto work = [&]
  {
    write(path.c_str());
    return path;
  };
  return meam::runInChildProcess(work, {}).value_or("Open CASCADE crashed");
}

double mmOf(const std::string& unit) { return unit == "INCH" ? Inch : unit == "M" ? 1000.0 : 1.0; }

/// A file of a shape whose lengths are mm; the lengths in the file are of the unit.
std::string stepOf(const files::Folder& folder, const TopoDS_Shape& shape, const char* unit = "MM",
  const char* name = "part.step", STEPControl_StepModelType type = STEPControl_AsIs)
{
  return written(folder.path(name),
    [&](const char* path)
    {
      STEPControl_Controller::Init();
      Interface_Static::SetCVal("write.step.unit", unit);
      STEPControl_Writer writer;
      writer.Model()->SetLocalLengthUnit(1.0); // mm: from Open CASCADE 7.8 on it takes lengths for the file's otherwise
      writer.Model()->SetWriteLengthUnit(mmOf(unit));
      writer.Transfer(shape, type);
      writer.Write(path);
    });
}

/// `mode`: 0, faces without their neighbours, or 1, solids.
std::string igesOf(const files::Folder& folder, const TopoDS_Shape& shape, const char* unit, int mode = 0)
{
  return written(folder.path("part.IGS"),
    [&](const char* path)
    {
      IGESControl_Controller::Init();
      IGESControl_Writer writer(unit, mode);
      writer.AddShape(shape);
      writer.ComputeModel();
      writer.Write(path);
    });
}

void expectSizes(const meam::TriangleMesh& mesh, double x, double y, double z)
{
  constexpr float close = 0.01f; // mm
  const Eigen::Vector3f sizes = meam::bounds(mesh.vertices).sizes();
  EXPECT_TRUE(sizes.isApprox(Eigen::Vector3d(x, y, z).cast<float>(), close / static_cast<float>(x)))
    << sizes.transpose();
}

/// The file of a damaged or missing part says so in these words.
void expectError(const std::string& path, const std::string& words = "")
{
  const std::string error = files::errorOf([&] { meam::readCAD(path); });
  EXPECT_TRUE(files::contains(error, path) && files::contains(error, words)) << error;
}

TopoDS_Compound compoundOf(const TopoDS_Shape& one, const TopoDS_Shape& other)
{
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, one);
  builder.Add(both, other);
  return both;
}

/// A box of 10 x 20 x 30 mm without one of its faces.
TopoDS_Shell openBox()
{
  TopoDS_Shell shell;
  BRep_Builder builder;
  builder.MakeShell(shell);
  TopExp_Explorer face(box(10, 20, 30), TopAbs_FACE);
  for (face.Next(); face.More(); face.Next())
  {
    builder.Add(shell, face.Current());
  }
  return shell;
}

TopoDS_Shape rod() { return BRepPrimAPI_MakeCylinder(10, 30).Shape(); }
constexpr double RodVolume = M_PI * 1e2 * 30;

}

TEST(CADFile, lengthsComeInMmWhateverTheUnitOfTheFileIs)
{
  const files::Folder folder;
  const TopoDS_Shape shape = box(10 * Inch, 20 * Inch, 30 * Inch);
  for (const char* unit : { "MM", "INCH", "M" })
  {
    const meam::CADPart part = meam::readCAD(stepOf(folder, shape, unit, "part.STP"));
    expectSizes(part.mesh, 254, 508, 762);
    EXPECT_NEAR(parts::volume(part.mesh), 254.0 * 508 * 762, 1e3);
    EXPECT_EQ(part.mesh.vertices.size(), 8u);
    EXPECT_EQ(part.mesh.triangles.size(), 12u);
    EXPECT_EQ(part.report, "");
  }
}

TEST(CADFile, curvedFacesAreClosedAndLookOutwards)
{
  const files::Folder folder;
  const double ball = 4.0 / 3.0 * M_PI * 1e3, tip = RodVolume / 3.0;
  for (const auto& [shape, expected] : { std::pair(rod(), RodVolume),
         std::pair(BRepPrimAPI_MakeSphere(10).Shape(), ball), std::pair(BRepPrimAPI_MakeCone(10, 0, 30).Shape(), tip) })
  {
    const meam::TriangleMesh mesh = meam::readCAD(stepOf(folder, shape)).mesh;
    parts::expectTwoFacesAtEachEdge(mesh, 0.0f);
    EXPECT_NEAR(parts::volume(mesh) / expected, 1.0, 0.01);
  }
}

TEST(CADFile, facesWhereFilletsMeetAreTriangulated)
{
  // Of this shape two faces, where fillets meet in the inner corner, are triangulated once they are healed.
  const files::Folder folder;
  const std::string path = folder.path("fillets.step");
  const auto write = [](const char* to)
  {
    const TopoDS_Shape angle =
      BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(60, 40, 12).Shape(), BRepPrimAPI_MakeBox(12, 40, 38).Shape()).Shape();
    BRepFilletAPI_MakeFillet fillets(angle);
    TopTools_IndexedMapOfShape edges; // counted from 1
    TopExp::MapShapes(angle, TopAbs_EDGE, edges);
    for (int i = 1; i <= edges.Extent(); ++i)
    {
      fillets.Add(0.7, TopoDS::Edge(edges(i)));
    }
    STEPControl_Writer writer;
    writer.Transfer(fillets.Shape(), STEPControl_AsIs);
    writer.Write(to);
  };
  const meam::TriangleMesh mesh = meam::readCAD(written(path, write)).mesh;
  expectSizes(mesh, 60, 40, 38);
  EXPECT_NEAR(parts::volume(mesh) / (60.0 * 40 * 12 + 12.0 * 40 * 26), 1.0, 0.01);
}

TEST(CADFile, sharpEdgesOfTheMeshAreThoseOfTheSurfaces)
{
  const files::Folder folder;
  const auto lengthOf = [&](const TopoDS_Shape& shape)
  {
    meam::FeatureEdgesSettings settings;
    settings.spacing = 0.1;
    const meam::TriangleMesh mesh = meam::readCAD(stepOf(folder, shape)).mesh;
    return settings.spacing * static_cast<double>(meam::extractFeatureEdges(mesh, settings).points.size());
  };
  EXPECT_NEAR(lengthOf(rod()), 2 * 2 * M_PI * 10, 0.5); // not its seam
  EXPECT_EQ(lengthOf(BRepPrimAPI_MakeSphere(10).Shape()), 0.0);
}

TEST(CADFile, trianglesAreNoCoarserWherePolesLieFarOffTheSurface)
{
  // z = 3 T6(x / 50) mm, of the Chebyshev polynomial T6: the poles reach 139 mm, the surface 3.
  constexpr std::array<double, 7> poles{ 1, -11, 33, -46.2, 33, -11, 1 };
  TColgp_Array2OfPnt grid(1, 7, 1, 2);
  for (int i = 0; i < 7; ++i)
  {
    grid.SetValue(i + 1, 1, gp_Pnt(100.0 * i / 6 - 50, 0, 3 * poles[i]));
    grid.SetValue(i + 1, 2, gp_Pnt(100.0 * i / 6 - 50, 20, 3 * poles[i]));
  }
  const files::Folder folder;
  const TopoDS_Shape face = BRepBuilderAPI_MakeFace(new Geom_BezierSurface(grid), 1e-6).Shape();
  const meam::TriangleMesh mesh = meam::readCAD(stepOf(folder, face)).mesh;
  expectSizes(mesh, 100, 20, 6);
  double farthest = 0.0; // middles of sides from the surface
  for (const auto& triangle : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3f middle = (mesh.vertices[triangle[k]] + mesh.vertices[triangle[(k + 1) % 3]]) / 2;
      const double angle = std::acos(std::clamp(middle.x() / 50.0, -1.0, 1.0)); // T6(cos a) = cos 6a
      const double slope = 3 * 6 * std::sin(6 * angle) / std::max(std::sin(angle), 1e-3) / 50;
      farthest = std::max(farthest, std::abs(middle.z() - 3 * std::cos(6 * angle)) / std::hypot(1.0, slope));
    }
  }
  EXPECT_LE(farthest, 2e-4 * std::sqrt(100.0 * 100 + 20 * 20 + 6 * 6));
}

TEST(CADFile, allSolidsAreOnePartWhereTheyArePlaced)
{
  const files::Folder folder;
  gp_Trsf place;
  place.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), M_PI / 2.0);
  place.SetTranslationPart(gp_Vec(100, 0, 0));
  const TopoDS_Shape shape = box(10, 20, 30);
  // The same shape again, as in an assembly.
  const meam::CADPart part = meam::readCAD(stepOf(folder, compoundOf(shape, shape.Moved(place))));
  expectSizes(part.mesh, 100, 20, 30);
  parts::expectTwoFacesAtEachEdge(part.mesh, 0.0f);
  EXPECT_NEAR(parts::volume(part.mesh), 2 * 6000.0, 0.1);
  EXPECT_TRUE(files::contains(part.report, "2 solids")) << part.report;
  EXPECT_TRUE(files::contains(part.report, "(solid): 1 is 10 x 20 x 30 mm, 2 is 20 x 10 x 30 mm.")) << part.report;
  EXPECT_TRUE(files::contains(part.report, "12 triangles, far off the rest")) << part.report;
}

TEST(CADFile, oneSolidIsChosen)
{
  const files::Folder folder;
  gp_Trsf place;
  place.SetTranslation(gp_Vec(100, 0, 0));
  const std::string path = stepOf(folder, compoundOf(box(10, 20, 30), rod().Moved(place)));
  const meam::CADPart first = meam::readCAD(path, { 1 }), second = meam::readCAD(path, { 2 });
  expectSizes(first.mesh, 10, 20, 30);
  EXPECT_EQ(first.report, "");
  parts::expectTwoFacesAtEachEdge(second.mesh, 0.0f);
  EXPECT_NEAR(parts::volume(second.mesh) / RodVolume, 1.0, 0.01);
  EXPECT_NEAR(second.mesh.vertices.front().x(), 100.0f, 10.01f); // where the file puts it
  const auto error = [](const std::string& file, int solid)
  { return files::errorOf([&] { meam::readCAD(file, { solid }); }); };
  EXPECT_TRUE(files::contains(error(path, 3), "holds 2 solids, no solid 3: choose one from 1 to 2")) << error(path, 3);
  EXPECT_TRUE(files::contains(error(path, -1), "0 (all) or more, not -1"));
  EXPECT_TRUE(files::contains(error(igesOf(folder, openBox(), "MM"), 1), "enclose no solid: choose solid 0"));
  const std::string mesh = folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_TRUE(files::contains(error(mesh, 1), "is a mesh, which has no solids"));
}

TEST(CADFile, shellsThatCloseAreSolids)
{
  const files::Folder folder;
  gp_Trsf place;
  place.SetTranslation(gp_Vec(100, 0, 0));
  const std::string path = igesOf(folder, compoundOf(box(10, 20, 30), box(5, 6, 7).Moved(place)), "MM"); // faces alone
  const std::string report = meam::readCAD(path).report;
  EXPECT_TRUE(files::contains(report, "1 is 10 x 20 x 30 mm, 2 is 5 x 6 x 7 mm.")) << report;
  const meam::CADPart first = meam::readCAD(path, { 1 }), second = meam::readCAD(path, { 2 });
  expectSizes(first.mesh, 10, 20, 30);
  EXPECT_EQ(first.report, "");
  expectSizes(second.mesh, 5, 6, 7);
}

TEST(CADFile, aFaceBesideSolidsLeavesThemWhole)
{
  const files::Folder folder;
  TopoDS_Solid hollow;
  BRep_Builder builder;
  builder.MakeSolid(hollow);
  builder.Add(hollow, TopExp_Explorer(box(30, 30, 30), TopAbs_SHELL).Current());
  gp_Trsf inside;
  inside.SetTranslation(gp_Vec(10, 10, 10));
  builder.Add(hollow, TopExp_Explorer(box(5, 6, 7).Moved(inside), TopAbs_SHELL).Current().Reversed());
  gp_Trsf place;
  place.SetTranslation(gp_Vec(0, 0, 100));
  const TopoDS_Shape face = TopExp_Explorer(box(30, 30, 1).Moved(place), TopAbs_FACE).Current();
  const std::string path = igesOf(folder, compoundOf(hollow, face), "MM", 1);
  const meam::TriangleMesh solid = meam::readCAD(path, { 1 }).mesh;
  expectSizes(solid, 30, 30, 30);
  EXPECT_NEAR(parts::volume(solid), 27000.0 - 210.0, 0.1);
  EXPECT_TRUE(
    files::contains(files::errorOf([&] { meam::readCAD(path, { 2 }); }), "holds 1 solid, no solid 2: choose 1"));
}

TEST(CADFile, openShellsAreRead)
{
  const files::Folder folder;
  const meam::CADPart part =
    meam::readCAD(stepOf(folder, openBox(), "MM", "part.step", STEPControl_ShellBasedSurfaceModel));
  expectSizes(part.mesh, 10, 20, 30);
  EXPECT_EQ(part.mesh.triangles.size(), 10u);
  EXPECT_EQ(part.mesh.vertices.size(), 8u);
}

TEST(CADFile, facesOfIGESAreSewn)
{
  const files::Folder folder;
  for (const char* unit : { "MM", "INCH" })
  {
    const meam::TriangleMesh mesh = meam::readCAD(igesOf(folder, box(10, 20, 30), unit)).mesh;
    expectSizes(mesh, 10, 20, 30);
    EXPECT_EQ(mesh.vertices.size(), 8u);
  }
  const meam::MeshReport report = meam::prepareMesh(meam::readCAD(igesOf(folder, rod(), "MM")).mesh).report;
  EXPECT_EQ(report.nearVertices + report.mergedVertices, 0);
  EXPECT_TRUE(report.closed);
  EXPECT_NEAR(report.volume / RodVolume, 1.0, 0.01);
}

TEST(CADFile, facesBetweenEdgesThatLieOnEachOtherAreLeftOut)
{
  const files::Folder folder;
  const TopoDS_Edge there = BRepBuilderAPI_MakeEdge(gp_Pnt(20, 0, 0), gp_Pnt(25, 0, 0));
  const TopoDS_Edge back = BRepBuilderAPI_MakeEdge(TopExp::LastVertex(there), TopExp::FirstVertex(there));
  const TopoDS_Face sliver = BRepBuilderAPI_MakeFace(gp_Pln(), BRepBuilderAPI_MakeWire(there, back), true);
  expectSizes(meam::readCAD(stepOf(folder, compoundOf(box(10, 20, 30), sliver))).mesh, 10, 20, 30);
}

TEST(CADFile, entitiesWithoutNamesAreRead)
{
  const files::Folder folder;
  std::string text = meam::readFile(stepOf(folder, box(10, 20, 30)));
  for (const std::string entity : { "CLOSED_SHELL(''", "ADVANCED_FACE(''", "EDGE_CURVE(''", "PLANE(''" })
  {
    text.replace(text.find(entity) + entity.size() - 2, 2, "$");
  }
  text.insert(text.find("DATA;") + 5, "#9001=SURFACE_SIDE_STYLE($,());#9002=SURFACE_STYLE_USAGE($,#9001);");
  expectSizes(meam::readCAD(folder.write("names.step", text)).mesh, 10, 20, 30);
}

TEST(CADFile, whatIsDamagedIsASentence)
{
  const files::Folder folder;
  const std::string whole = meam::readFile(stepOf(folder, box(10, 20, 30)));
  for (const char* name : { "empty.step", "empty.igs" })
  {
    expectError(folder.write(name, ""));
    expectError(folder.write(name, "solid part\n"));
    expectError(folder.path("no.step"));
  }
  expectError(folder.write("cut.step", whole.substr(0, whole.size() / 2)), "cut off");
  const std::string iges = meam::readFile(igesOf(folder, box(10, 20, 30), "MM"));
  expectError(folder.write("cut.igs", iges.substr(0, iges.size() * 9 / 10)), "cut off");

  // A face whose surface is no surface.
  std::string other = whole;
  const std::size_t face = other.find("ADVANCED_FACE");
  const std::size_t surface = other.find(",#", face) + 2;
  other.replace(surface, other.find(',', surface) - surface, "1");
  expectError(folder.write("other.step", other), "damaged");
  const TopoDS_Shape line = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Shape();
  expectError(stepOf(folder, line), "no surface");
}

TEST(CADFile, whatIsMissingIsASentence)
{
  const files::Folder folder;
  const std::string whole = meam::readFile(stepOf(folder, box(10, 20, 30)));
  // A list without one of its entities, which Open CASCADE reads as a shorter list.
  std::string text = whole;
  const std::size_t edge = text.rfind('#', text.find("ORIENTED_EDGE"));
  const std::string name = text.substr(edge, text.find(' ', edge) - edge);
  text.erase(edge, text.find(';', edge) + 1 - edge);
  expectError(folder.write("edge.step", text), "refers to " + name + ", which");
  text = whole;
  text.insert(text.find("DATA;"), "/* #7 of 'it */");
  text.insert(text.find("'", text.find("DATA;")) + 1, "it''s #9");
  EXPECT_EQ(meam::readCAD(folder.write("quoted.step", text)).mesh.triangles.size(), 12u);
  // A cylinder that is none.
  const std::string cylinder = meam::readFile(stepOf(folder, rod()));
  const std::size_t radius = cylinder.find(",10.)", cylinder.find("CYLINDRICAL_SURFACE")) + 1;
  expectError(folder.write("thin.step", std::string(cylinder).replace(radius, 3, "0.")),
    "has 1 of its 3 faces damaged: they cannot be triangulated");
  expectError(folder.write("negative.step", std::string(cylinder).insert(radius, "-")),
    "in an entity StepGeom_CylindricalSurface of it, of which");

  const std::string iges = meam::readFile(igesOf(folder, box(10, 20, 30), "MM"));
  constexpr std::size_t length = 81; // of a line with its end
  const auto without = [&](const char* line)
  {
    std::string result = iges;
    return result.erase(result.find(line) / length * length, length);
  };
  expectError(folder.write("line.igs", without("P0000005")), "lines of the section P instead of");
  expectError(folder.write("entity.igs", without("D0000003")), "lines of the section D instead of");
  text = iges;
  text.replace(text.find("\n144,") + 5, 2, "99"); // a face of another surface
  expectError(folder.write("surface.igs", text), "in an entity IGESGeom_TrimmedSurface of it, of which");
}

TEST(CADFile, aByteOrderMarkIsSkipped)
{
  const files::Folder folder;
  for (const std::string& path : { stepOf(folder, box(30, 20, 10)), igesOf(folder, box(30, 20, 10), "MM") })
  {
    const meam::TriangleMesh mesh = meam::readCAD(path).mesh;
    folder.write(std::filesystem::path(path).filename(), "\xef\xbb\xbf" + meam::readFile(path));
    EXPECT_EQ(meam::readCAD(path).mesh.vertices, mesh.vertices) << path;
  }
}
