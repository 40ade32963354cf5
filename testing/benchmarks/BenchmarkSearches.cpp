// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkScene.h"
#include "base/sequences/Sequences.h"
#include "io/cloud/PCDFile.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshPreparation.h"

#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>

namespace scenes
{
namespace
{
meam::Scene preparedOf(const Seen& seen, double diameter) { return prepared(withTangents(seen, diameter), diameter); }

/// A trained part and a scene of it, kept.
struct KeptSearch
{
  KeptSearch(meam::TrainedModel trained, Seen inScene)
    : model(std::move(trained))
    , seen(std::move(inScene))
    , scene(preparedOf(this->seen, this->model.diameter))
  {
  }

  meam::TrainedModel model;
  Seen seen;
  meam::Scene scene;
  Search search{ model, scene, seen };
};

meam::TriangleMesh readAsciiSTL(const std::string& path)
{
  std::ifstream file(path);
  meam::TriangleMesh mesh;
  for (std::string word; file >> word;)
  {
    if (word == "vertex")
    {
      Eigen::Vector3f& vertex = mesh.vertices.emplace_back();
      file >> vertex.x() >> vertex.y() >> vertex.z();
    }
  }
  for (int i = 0; i + 2 < static_cast<int>(mesh.vertices.size()); i += 3)
  {
    mesh.triangles.emplace_back(i, i + 1, i + 2);
  }
  return meam::prepareMesh(mesh).mesh;
}

/// Made once for each argument.
template <typename Value, typename Make>
const Value& kept(std::map<int, Value>& values, int argument, Make&& make)
{
  const auto found = values.find(argument);
  return found != values.end() ? found->second : values[argument] = make();
}

const Seen& seenBrackets(int copies)
{
  static std::map<int, Seen> seen;
  return kept(seen, copies,
    [&]
    {
      const int inRow = static_cast<int>(std::ceil(std::sqrt(copies)));
      const auto poses = meam::ofIndices<Eigen::Isometry3d>(copies,
        [&](int i) -> Eigen::Isometry3d
        { return lying(80.0 * (i % inRow), 80.0 * (i / inRow), 37.0 * i, i % 2 == 0); });
      return seenFromAbove(poses);
    });
}

const meam::Scene& sceneOfBrackets(int copies)
{
  static std::map<int, std::unique_ptr<const meam::Scene>> built;
  return *kept(built, copies,
    [&] {
      return std::unique_ptr<const meam::Scene>(new meam::Scene(preparedOf(seenBrackets(copies), bracket().diameter)));
    });
}
}

Search searchOfCopies(int copies) { return { bracket(), sceneOfBrackets(copies), seenBrackets(copies) }; }

Search searchOfThinned(int tenths)
{
  static std::map<int, meam::TrainedModel> models;
  const meam::TrainedModel& model = kept(models, tenths,
    [&]
    {
      meam::TrainingSettings settings = meam::trainingSettings(meam::Preset::Recommended);
      settings.tangents.leafSize = 0.1 * tenths;
      return meam::trainModel(parts::lBracket(), settings);
    });
  return { model, sceneOfBrackets(12), seenBrackets(12) };
}

const Search* bracketSearch()
{
  static const Search search = searchOfCopies(12);
  return &search;
}

const Search* tohokuSearch()
{
  static const std::unique_ptr<KeptSearch> kept = []() -> std::unique_ptr<KeptSearch>
  {
    const char* data = std::getenv("PPFMEAM_DATA");
    const std::string folder = std::string(data ? data : "") + "/tohoku/Part_1/";
    if (!std::ifstream(folder + "Part_1.STL"))
    {
      return nullptr;
    }
    const meam::TriangleMesh mesh = readAsciiSTL(folder + "Part_1.STL");
    Seen seen;
    seen.surface = meam::readPCD(folder + "Scenes/Scene0.pcd").cloud.points;
    seen.edges.points = meam::readPCD(folder + "Scenes/Scene_boundary0.pcd").cloud.points;
    seen.sensor.perspective = false;
    seen.sensor.direction = -Eigen::Vector3d::UnitZ();
    return std::make_unique<KeptSearch>(
      meam::trainModel(mesh, meam::trainingSettings(meam::Preset::Recommended)), std::move(seen));
  }();
  return kept ? &kept->search : nullptr;
}
}
