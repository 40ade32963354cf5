// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad/BRepMesh.h"

#include "base/Bounds.h"
#include "base/Error.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/TextLines.h"

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <IGESControl_Reader.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeFix_Shape.hxx>
#include <Standard_Failure.hxx>
#include <StepShape_TopologicalRepresentationItem.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace meam
{
namespace
{
// Of the diagonal of the part's bounds: how far triangles are from the surface, below what sensors measure.
constexpr double Deflection = 2e-4;
// Between neighbouring triangles and chords of what is too small for the deflection to count. A quarter of the angle
// that makes an edge sharp, so that no triangles of a smooth face meet at one, and sizes of parts come out to 0.01 mm.
constexpr double Angle = 8.0 * M_PI / 180.0;
// Of the diagonal: how far apart edges may lie of faces that come without their neighbours and are sewn.
constexpr double SewingTolerance = 1e-4;

// Of the length that the deflection was taken of: where triangles are so much shorter, poles of the surface lay far off
// it, of which its bounds are made.
constexpr double MuchShorter = 0.9;

constexpr int EdgeChecks = 8; // parts of an edge between which it is compared with others: a bend of it is seen

constexpr std::size_t IGESSection = 72; // where in a line the letter is that tells its section
constexpr std::size_t IGESCount = 8;    // in the last line: a section's letter and its number of lines

[[noreturn]] void failBRep(const std::string& path, const std::string& what)
{
  throw Error("The CAD file '" + path + "' " + what + ".");
}

double diagonalOf(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

/// What Open CASCADE, which takes a byte order mark for damage, reads of a file: of one with it the bytes behind it, in
/// a file in memory.
class FileWithoutMark
{
public:
  explicit FileWithoutMark(const std::string& path)
    : Path(path)
  {
    const std::string bytes = readFile(path);
    const std::string_view text = withoutMark(bytes);
    if (text.size() == bytes.size())
    {
      return;
    }
    this->Memory = memfd_create("CAD", MFD_CLOEXEC);
    this->Path = "/proc/self/fd/" + std::to_string(this->Memory);
    for (std::size_t at = 0; at < text.size();)
    {
      const ssize_t written = write(this->Memory, text.data() + at, text.size() - at);
      if (written <= 0)
      {
        failBRep(path, "begins with a byte order mark and cannot be copied without it: remove the mark");
      }
      at += static_cast<std::size_t>(written);
    }
  }
  ~FileWithoutMark()
  {
    if (this->Memory >= 0)
    {
      close(this->Memory);
    }
  }
  FileWithoutMark(const FileWithoutMark&) = delete;
  FileWithoutMark& operator=(const FileWithoutMark&) = delete;

  const std::string& path() const { return this->Path; }

private:
  std::string Path;
  int Memory = -1;
};

void load(const std::string& path, XSControl_Reader& reader)
{
  if (reader.ReadFile(FileWithoutMark(path).path().c_str()) != IFSelect_RetDone)
  {
    failBRep(path, "is cut off or damaged, or is of another kind than its name says");
  }
}

/// A STEP text with blanks in place of its comments and of what it quotes.
std::string bareSTEP(std::string text)
{
  for (std::size_t at = 0; (at = text.find_first_of("'/", at)) != std::string::npos; ++at)
  {
    const bool isComment = text.compare(at, 2, "/*") == 0;
    if (isComment || text[at] == '\'')
    {
      const std::string_view close = isComment ? "*/" : "'";
      const std::size_t end = std::min(text.find(close, at + close.size()), text.size() - close.size()) + close.size();
      std::fill(text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    }
  }
  return text;
}

/// Every #7 is an entity of the file: what refers to another one Open CASCADE leaves out of lists.
void requireReferences(const std::string& path)
{
  const std::string text = bareSTEP(readFile(path));
  std::vector<std::uint64_t> entities, references;
  for (std::size_t at = 0; (at = text.find('#', at)) != std::string::npos;)
  {
    std::uint64_t number = 0;
    const auto [end, failure] = std::from_chars(text.data() + at + 1, text.data() + text.size(), number);
    at = static_cast<std::size_t>(end - text.data());
    const std::size_t next = text.find_first_not_of(" \t\r\n", at);
    if (failure == std::errc())
    {
      (next < text.size() && text[next] == '=' ? entities : references).push_back(number);
    }
  }
  std::sort(entities.begin(), entities.end());
  for (const std::uint64_t number : references)
  {
    if (!std::binary_search(entities.begin(), entities.end(), number))
    {
      failBRep(path, "refers to #" + std::to_string(number) + ", which it does not have: it is cut off or damaged");
    }
  }
}

/// Whether all that is wrong with an entity is its name, which some programs leave out.
bool lacksName(const Interface_Check& check)
{
  for (int i = 1; i <= check.NbFails(); ++i)
  {
    if (std::string_view(check.CFail(i)).find("(name)") == std::string_view::npos)
    {
      return false;
    }
  }
  return true;
}

/// Open CASCADE goes on without what it cannot make sense of, and leaves out faces or crashes. What is no surface may
/// be of a kind that it does not know, as annotations.
void requireSurfaces(const std::string& path, const XSControl_Reader& reader)
{
  Interface_CheckIterator checks = reader.WS()->ModelCheckList(false);
  for (checks.Start(); checks.More(); checks.Next())
  {
    const Handle(Interface_Check) check = checks.Value();
    const Handle(Standard_Transient) entity = check->Entity();
    if (!check->HasFailed() || entity.IsNull() || lacksName(*check))
    {
      continue;
    }
    const std::string type = entity->DynamicType()->Name();
    if (type.rfind("StepGeom_", 0) == 0 || entity->IsKind(STANDARD_TYPE(StepShape_TopologicalRepresentationItem)))
    {
      failBRep(path, "is damaged, in an entity " + type + " of it: " + check->CFail(1));
    }
  }
}

/// The same once shapes are made of the entities. Of others than surfaces and their boundaries it complains, too, where
/// it reads them.
void requireTransferred(const std::string& path, const XSControl_Reader& reader)
{
  const Handle(Transfer_TransientProcess) transfer = reader.WS()->TransferReader()->TransientProcess();
  const auto require = [&](Interface_CheckIterator checks, const auto& isLost)
  {
    for (checks.Start(); checks.More(); checks.Next())
    {
      const Handle(Standard_Transient) entity = checks.Value()->Entity();
      const std::string type = entity.IsNull() ? "" : entity->DynamicType()->Name();
      const bool isStyle = type.rfind("StepVisual_", 0) == 0;
      const bool isSurface = !isStyle && (type.rfind("StepGeom_", 0) == 0 || type.find("Surface") != std::string::npos);
      if (checks.Value()->HasFailed() && !lacksName(*checks.Value()) && isSurface && isLost(entity))
      {
        failBRep(path, "is damaged, in an entity " + type + " of it, of which nothing can be made");
      }
    }
  };
  using Entity = Handle(Standard_Transient);
  require(transfer->CheckList(false), [](const Entity&) { return true; });
  require(reader.WS()->ModelCheckList(false), [&](const Entity& entity) { return !transfer->IsBound(entity); });
}

TopoDS_Shape readSTEP(const std::string& path)
{
  STEPControl_Reader reader;
  load(path, reader);
  requireReferences(path);
  requireSurfaces(path, reader);
  reader.TransferRoots();
  requireTransferred(path, reader);
  return reader.OneShape();
}

/// The first line is of the start section, the last of the terminate section, which has the number of lines of each.
void requireSections(const std::string& path)
{
  const std::string bytes = readFile(path);
  const std::string_view text = withoutMark(bytes);
  const auto isOf = [&](char section, std::size_t line)
  { return text.size() > line + IGESSection && text[line + IGESSection] == section; };
  if (!isOf('S', 0))
  {
    failBRep(path, "is no IGES file of text in lines of 80 letters");
  }
  const std::size_t end = text.find_last_not_of(" \t\r\n\x1a");
  if (!isOf('T', text.rfind('\n', end) + 1))
  {
    failBRep(path, "is cut off: its last line is not that of the terminate section");
  }
  std::map<char, int> lines;
  const std::size_t last = text.rfind('\n', end) + 1;
  for (std::size_t line = 0; line < last; line = text.find('\n', line) + 1)
  {
    ++lines[text.find('\n', line) > line + IGESSection ? text[line + IGESSection] : ' '];
  }
  for (std::size_t at = last; at < last + IGESSection; at += IGESCount)
  {
    const std::string_view number = text.substr(at + 1, IGESCount - 1);
    const std::size_t first = std::min(number.find_first_not_of(' '), number.size());
    int count = 0;
    const bool isSection = std::string_view("SGDP").find(text[at]) != std::string_view::npos;
    if (isSection && parseNumber(number.substr(first), count) && lines[text[at]] != count)
    {
      failBRep(path, "has " + std::to_string(lines[text[at]]) + " lines of the section " + text[at] + " instead of " +
                       std::to_string(count) + ": it is damaged");
    }
  }
}

/// The shape with its faces of no shell, as IGES mostly has them, sewn to shells.
TopoDS_Shape sewn(const TopoDS_Shape& shape)
{
  TopExp_Explorer face(shape, TopAbs_FACE, TopAbs_SHELL);
  if (!face.More())
  {
    return shape;
  }
  BRepBuilderAPI_Sewing sewing(SewingTolerance * diagonalOf(shape));
  for (; face.More(); face.Next())
  {
    sewing.Add(face.Current());
  }
  sewing.Perform();
  TopoDS_Compound result;
  BRep_Builder builder;
  builder.MakeCompound(result);
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next())
  {
    builder.Add(result, solid.Current());
  }
  for (TopExp_Explorer shell(shape, TopAbs_SHELL, TopAbs_SOLID); shell.More(); shell.Next())
  {
    builder.Add(result, shell.Current());
  }
  builder.Add(result, sewing.SewedShape());
  return result;
}

TopoDS_Shape readIGES(const std::string& path)
{
  requireSections(path);
  IGESControl_Reader reader;
  load(path, reader);
  reader.TransferRoots();
  requireTransferred(path, reader);
  return reader.OneShape();
}

/// Puts the triangles of faces together; nodes on the edge that faces share become one vertex.
class FaceJoining
{
public:
  /// False for a face without triangles.
  bool add(const TopoDS_Face& face)
  {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, location);
    if (triangles.IsNull())
    {
      return false;
    }
    const gp_Trsf& toPart = location.Transformation();
    const int first = static_cast<int>(this->Places.size());
    for (int i = 1; i <= triangles->NbNodes(); ++i)
    {
      const gp_Pnt place = triangles->Node(i).Transformed(toPart);
      this->Places.emplace_back(place.X(), place.Y(), place.Z());
      this->Same.push_back(first + i - 1);
    }
    const bool isInwards = face.Orientation() == TopAbs_REVERSED;
    for (int i = 1; i <= triangles->NbTriangles(); ++i)
    {
      int a, b, c;
      triangles->Triangle(i).Get(a, b, c);
      this->Triangles.emplace_back(first + a - 1, first + (isInwards ? c : b) - 1, first + (isInwards ? b : c) - 1);
    }
    for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next())
    {
      this->join(TopoDS::Edge(edge.Current()), triangles, location, first);
    }
    return true;
  }

  TriangleMesh mesh()
  {
    TriangleMesh mesh;
    std::vector<int> vertexOf(this->Places.size(), -1);
    for (const Eigen::Vector3i& triangle : this->Triangles)
    {
      const Eigen::Vector3i corners = triangle.unaryExpr([&](int node) { return this->find(node); });
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
      {
        continue; // at the tip of a cone
      }
      mesh.triangles.push_back(corners.unaryExpr(
        [&](int place)
        {
          if (vertexOf[place] < 0)
          {
            vertexOf[place] = static_cast<int>(mesh.vertices.size());
            mesh.vertices.push_back(this->Places[place].cast<float>());
          }
          return vertexOf[place];
        }));
    }
    return mesh;
  }

private:
  int find(int node)
  {
    while (this->Same[node] != node)
    {
      node = this->Same[node] = this->Same[this->Same[node]];
    }
    return node;
  }

  void unite(int a, int b) { this->Same[this->find(b)] = this->find(a); }

  /// The nodes of an edge, which are as many in each of its faces.
  void join(
    const TopoDS_Edge& edge, const Handle(Poly_Triangulation) & triangles, const TopLoc_Location& location, int first)
  {
    const Handle(Poly_PolygonOnTriangulation) line = BRep_Tool::PolygonOnTriangulation(edge, triangles, location);
    if (line.IsNull())
    {
      return;
    }
    std::vector<int> nodes;
    for (int i = 1; i <= line->NbNodes(); ++i)
    {
      nodes.push_back(first + line->Node(i) - 1);
    }
    const std::size_t number = static_cast<std::size_t>(this->Edges.Add(edge));
    if (number > this->NodesOf.size())
    {
      this->NodesOf.push_back(nodes);
    }
    const std::vector<int>& known = this->NodesOf[number - 1];
    for (std::size_t i = 0; i < nodes.size() && nodes.size() == known.size(); ++i)
    {
      this->unite(known[i], nodes[i]);
      if (BRep_Tool::Degenerated(edge)) // a point
      {
        this->unite(known[0], nodes[i]);
      }
    }
  }

  std::vector<Eigen::Vector3d> Places; // of the nodes of all faces
  std::vector<int> Same;               // another node at the place of each, or itself
  std::vector<Eigen::Vector3i> Triangles;
  TopTools_IndexedMapOfShape Edges;      // counted from 1
  std::vector<std::vector<int>> NodesOf; // each edge in the first of its faces
};

/// Whether an edge runs along other edges of its face, no farther from them than that.
bool runsAlong(const TopoDS_Edge& edge, const TopoDS_Shape& others, double distance)
{
  double first, last;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  for (int i = 1; i < EdgeChecks && !curve.IsNull(); ++i)
  {
    gp_Pnt place;
    curve->D0(first + (last - first) * i / EdgeChecks, place);
    const BRepExtrema_DistShapeShape nearest(BRepBuilderAPI_MakeVertex(place), others);
    if (!nearest.IsDone() || !(nearest.Value() <= distance))
    {
      return false;
    }
  }
  return !curve.IsNull();
}

/// Whether a face would show in triangles that are so far off it. It does not when it is as small as that, or when its
/// boundary comes back where it went; on a surface that closes on itself, as a sphere's, it may come back round the
/// face. One without edges is damaged.
bool isSeen(const TopoDS_Face& face, double deflection)
{
  TopTools_IndexedMapOfShape edges; // counted from 1
  TopExp::MapShapes(face, TopAbs_EDGE, edges);
  bool isSeen = edges.IsEmpty();
  if (isSeen || diagonalOf(face) <= deflection)
  {
    return isSeen;
  }
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  isSeen = surface.IsNull() || (surface->IsUClosed() || surface->IsVClosed());
  for (int i = 1; i <= edges.Extent() && !isSeen; ++i)
  {
    TopoDS_Compound others;
    BRep_Builder builder;
    builder.MakeCompound(others);
    for (int k = 1; k <= edges.Extent(); ++k)
    {
      if (k != i)
      {
        builder.Add(others, edges(k));
      }
    }
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    isSeen = BRep_Tool::IsClosed(edge, face) || !(BRep_Tool::Degenerated(edge) || runsAlong(edge, others, deflection));
  }
  return isSeen;
}

struct Triangulation
{
  TriangleMesh mesh;
  int faces = 0, missing = 0; ///< that would be seen
};

Triangulation triangulated(const TopoDS_Shape& shape, double diagonal)
{
  IMeshTools_Parameters fineness;
  fineness.Deflection = fineness.DeflectionInterior = Deflection * diagonal;
  fineness.Angle = fineness.AngleInterior = Angle;
  BRepMesh_IncrementalMesh(shape, fineness);
  FaceJoining joining;
  Triangulation result;
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next(), ++result.faces)
  {
    const bool isMissing = !joining.add(TopoDS::Face(face.Current()));
    result.missing += isMissing && isSeen(TopoDS::Face(face.Current()), fineness.Deflection);
  }
  result.mesh = joining.mesh();
  return result;
}

/// The boundaries of some faces, as where fillets of several edges meet, are triangulated once they are healed.
TriangleMesh meshOf(const std::string& path, TopoDS_Shape shape)
{
  const double diagonal = diagonalOf(shape);
  if (!(diagonal > 0.0))
  {
    return {};
  }
  Triangulation result = triangulated(shape, diagonal);
  if (result.missing > 0)
  {
    ShapeFix_Shape healing(shape);
    healing.Perform();
    shape = healing.Shape();
    BRepTools::Clean(shape); // faces that failed are not tried again otherwise
    result = triangulated(shape, diagonal);
  }
  const double length = bounds(result.mesh.vertices).diagonal().norm();
  if (length < MuchShorter * diagonal)
  {
    BRepTools::Clean(shape);
    result = triangulated(shape, length);
  }
  if (result.missing > 0)
  {
    failBRep(path, "has " + std::to_string(result.missing) + " of its " + std::to_string(result.faces) +
                     " faces damaged: they cannot be triangulated");
  }
  return result.mesh;
}

/// What may be a part of its own: solids, and after them shells of none that are closed, as faces of IGES are once
/// sewn.
std::vector<TopoDS_Shape> solidsIn(const TopoDS_Shape& shape)
{
  std::vector<TopoDS_Shape> solids;
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next())
  {
    solids.push_back(solid.Current());
  }
  for (TopExp_Explorer shell(shape, TopAbs_SHELL, TopAbs_SOLID); shell.More(); shell.Next())
  {
    if (BRep_Tool::IsClosed(shell.Current()))
    {
      solids.push_back(shell.Current());
    }
  }
  return solids;
}

/// The solid of that number, from 1; for 0 the whole shape.
TopoDS_Shape chosenSolid(const std::string& path, const TopoDS_Shape& shape, int solid)
{
  if (solid == 0)
  {
    return shape;
  }
  const std::vector<TopoDS_Shape> solids = solidsIn(shape);
  const int count = static_cast<int>(solids.size());
  if (count == 0)
  {
    failBRep(path, "holds surfaces that enclose no solid: choose solid 0, all of it");
  }
  if (solid > count)
  {
    const std::string number = std::to_string(count);
    failBRep(path, "holds " + number + (count == 1 ? " solid" : " solids") + ", no solid " + std::to_string(solid) +
                     ": choose " + (count == 1 ? "1" : "one from 1 to " + number) + ", or 0 for all together");
  }
  return solids[solid - 1];
}

Points sizesOf(const std::vector<TopoDS_Shape>& solids)
{
  Points sizes;
  for (const TopoDS_Shape& solid : solids)
  {
    Bnd_Box box;
    BRepBndLib::Add(solid, box);
    box.SetGap(0.0); // what tolerances add
    const gp_XYZ size = box.IsVoid() ? gp_XYZ() : box.CornerMax().XYZ() - box.CornerMin().XYZ();
    sizes.push_back(Eigen::Vector3d(size.X(), size.Y(), size.Z()).cast<float>());
  }
  return sizes;
}
}

BRepMesh meshOfBRep(const std::string& path, int solid)
{
  try
  {
    const std::string extension = extensionOf(path);
    const bool isIGES = extension == ".iges" || extension == ".igs";
    const TopoDS_Shape shape = chosenSolid(path, sewn(isIGES ? readIGES(path) : readSTEP(path)), solid);
    BRepMesh part{ meshOf(path, shape), {} };
    part.solidSizes = sizesOf(solidsIn(shape));
    return part;
  }
  catch (const Standard_Failure& failure)
  {
    failBRep(path, std::string("is damaged: ") + failure.GetMessageString());
  }
}
}
