// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/MeshEdges.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace meam
{
namespace
{
constexpr double MaximumSamples = 5e6; // 140 MB
// Of the largest coordinate: a triangle of less height is turned by the rounding of its corners to floats, 6e-8.
constexpr double Flat = 1e-6;

/// The edges at each vertex: those of vertex v are edges[starts[v]] to edges[starts[v + 1]].
struct Incidence
{
  Incidence(std::size_t vertices, const std::vector<std::array<int, 2>>& list)
    : starts(vertices + 1, 0)
    , edges(2 * list.size())
  {
    for (const auto& edge : list)
    {
      ++this->starts[edge[0] + 1];
      ++this->starts[edge[1] + 1];
    }
    for (std::size_t v = 0; v < vertices; ++v)
    {
      this->starts[v + 1] += this->starts[v];
    }
    std::vector<int> next(this->starts.begin(), this->starts.end() - 1);
    for (std::size_t e = 0; e < list.size(); ++e)
    {
      this->edges[next[list[e][0]]++] = static_cast<int>(e);
      this->edges[next[list[e][1]]++] = static_cast<int>(e);
    }
  }

  int degree(int vertex) const { return this->starts[vertex + 1] - this->starts[vertex]; }

  std::vector<int> starts;
  std::vector<int> edges;
};

/// An edge of a chain, in the direction of the walk.
struct Step
{
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  int edge;
};

void sampleChain(const std::vector<Step>& chain, double spacing, std::vector<EdgeSample>& samples)
{
  const double length = sumOf(chain, [](const Step& step) { return (step.to - step.from).norm(); });
  const double count = std::round(length / spacing);
  if (!(static_cast<double>(samples.size()) + count <= MaximumSamples))
  {
    throw Error("The spacing of the edge points is too small for the part (it asks for more than " +
                std::to_string(static_cast<int>(MaximumSamples)) +
                " points): enlarge it, or check the unit of the CAD file.");
  }
  double walked = 0.0;
  double k = 0.0;
  for (const auto& step : chain)
  {
    const Eigen::Vector3d way = step.to - step.from;
    const double end = &step == &chain.back() ? length : walked + way.norm();
    for (; k < count && (k + 0.5) * length / count <= end; ++k)
    {
      const double share = ((k + 0.5) * length / count - walked) / way.norm();
      samples.push_back({ (step.from + share * way).cast<float>(), way.normalized().cast<float>(), step.edge });
    }
    walked = end;
  }
}

/// Gives needles the normal of the face beside their longest edge, which may be a needle, too.
void takeFromNeighbours(
  const TriangleMesh& mesh, const std::vector<MeshEdge>& edges, std::map<int, int>& needles, Points& normals)
{
  if (needles.empty())
  {
    return;
  }
  const auto lengthOf = [&](int edge)
  {
    const auto [first, second] = edges[edge].vertices;
    return (mesh.vertices[first] - mesh.vertices[second]).norm();
  };
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    for (const int face : edges[e].faces)
    {
      const auto needle = needles.find(face);
      if (needle != needles.end() && (needle->second < 0 || lengthOf(static_cast<int>(e)) > lengthOf(needle->second)))
      {
        needle->second = static_cast<int>(e);
      }
    }
  }
  for (bool isGoingOn = true; isGoingOn;)
  {
    isGoingOn = false;
    for (auto needle = needles.begin(); needle != needles.end();)
    {
      const auto& [face, edge] = *needle;
      const bool isBetweenTwo = edge >= 0 && edges[edge].faceCount == 2;
      const int beside = isBetweenTwo ? edges[edge].faces[edges[edge].faces[0] == face ? 1 : 0] : -1;
      if (isBetweenTwo && needles.count(beside) == 0)
      {
        normals[face] = normals[beside];
        needle = needles.erase(needle);
        isGoingOn = true;
        continue;
      }
      ++needle;
    }
  }
}
}

std::vector<MeshEdge> edgesOf(const TriangleMesh& mesh)
{
  struct Side
  {
    std::array<int, 2> vertices;
    int face;
    bool operator<(const Side& other) const
    {
      return this->vertices != other.vertices ? this->vertices < other.vertices : this->face < other.face;
    }
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      sides.push_back({ { low, high }, static_cast<int>(t) });
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<MeshEdge> edges;
  for (const auto& side : sides)
  {
    if (edges.empty() || edges.back().vertices != side.vertices)
    {
      edges.push_back({ side.vertices, { side.face, -1 }, 1 });
    }
    else if (++edges.back().faceCount == 2)
    {
      edges.back().faces[1] = side.face;
    }
  }
  return edges;
}

Points faceNormals(const TriangleMesh& mesh, const std::vector<MeshEdge>& edges)
{
  float largest = 0.0f;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
  {
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
  }
  Points normals;
  normals.reserve(mesh.triangles.size());
  std::map<int, int> needles; // to the edge that is the longest, once it is known
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3d a = mesh.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[triangle[1]].cast<double>();
    const Eigen::Vector3d c = mesh.vertices[triangle[2]].cast<double>();
    const Eigen::Vector3d area = (b - a).cross(c - a);
    const double longest = std::max({ (b - a).norm(), (c - b).norm(), (a - c).norm() });
    if (area.norm() <= Flat * largest * longest)
    {
      needles.emplace(static_cast<int>(normals.size()), -1);
    }
    normals.push_back(area.stableNormalized().cast<float>());
  }
  takeFromNeighbours(mesh, edges, needles, normals);
  return normals;
}

std::vector<EdgeSample> sampleEdges(
  const Points& vertices, const std::vector<std::array<int, 2>>& edges, double spacing)
{
  if (!(spacing > 0.0) || !std::isfinite(spacing))
  {
    throw Error("The spacing of the edge points must be a positive length in mm.");
  }
  const Incidence incidence(vertices.size(), edges);
  std::vector<bool> done(edges.size(), false);
  std::vector<EdgeSample> samples;
  std::vector<Step> chain;
  const auto walk = [&](int vertex, int edge)
  {
    chain.clear();
    while (!done[edge])
    {
      done[edge] = true;
      const int next = edges[edge][0] == vertex ? edges[edge][1] : edges[edge][0];
      chain.push_back({ vertices[vertex].cast<double>(), vertices[next].cast<double>(), edge });
      vertex = next;
      if (incidence.degree(vertex) != 2)
      {
        break;
      }
      const int first = incidence.starts[vertex];
      edge = incidence.edges[incidence.edges[first] == edge ? first + 1 : first];
    }
    sampleChain(chain, spacing, samples);
  };
  // Chains with ends, then rings.
  for (const bool rings : { false, true })
  {
    for (std::size_t v = 0; v < vertices.size(); ++v)
    {
      const int vertex = static_cast<int>(v);
      if ((incidence.degree(vertex) == 2) != rings)
      {
        continue;
      }
      for (int i = incidence.starts[vertex]; i < incidence.starts[vertex + 1]; ++i)
      {
        if (!done[incidence.edges[i]])
        {
          walk(vertex, incidence.edges[i]);
        }
      }
    }
  }
  return samples;
}
}
