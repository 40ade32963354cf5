// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/StrayComponents.h"

#include "base/sequences/Sequences.h"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

namespace meam
{
namespace
{
// In diagonals of the rest's bounds: farther off nothing is that moves with a part, as screws whose thread is left out.
constexpr double FarOff = 0.5;
// A sheet's own face spans as much as the sheet; planes of construction are drawn somewhat larger than the part.
constexpr double LargePlane = 1.5;
constexpr double Flat = 1e-4;        // of its diagonal: so thin is a plane, whatever its coordinates are rounded to
constexpr std::size_t MostTold = 3;  // components, one by one: a sentence holds no more
constexpr std::size_t FewDigits = 4; // of lengths: enough to find the place again

struct MeshComponent
{
  int triangles = 0;
  double area = 0.0;
  Eigen::AlignedBox3f bounds;
  Eigen::Vector3d corner, normal; // of its largest triangle
  double largestArea = 0.0;
  bool isPlane = true;

  double diagonal() const { return this->bounds.diagonal().norm(); }
};

/// Of each vertex one of its component: those of a triangle, and those at the same place, are of one.
std::vector<int> componentRoots(const TriangleMesh& mesh)
{
  const int count = static_cast<int>(mesh.vertices.size());
  std::vector<int> parents(count), order(count);
  std::vector<unsigned char> ranks(count, 0);
  std::iota(parents.begin(), parents.end(), 0);
  std::iota(order.begin(), order.end(), 0);
  boost::disjoint_sets<unsigned char*, int*> sets(ranks.data(), parents.data());
  const auto place = [&](int vertex) { return mesh.vertices[vertex].data(); };
  std::sort(order.begin(), order.end(),
    [&](int a, int b) { return std::lexicographical_compare(place(a), place(a) + 3, place(b), place(b) + 3); });
  for (int i = 1; i < count; ++i)
  {
    if (mesh.vertices[order[i]] == mesh.vertices[order[i - 1]])
    {
      sets.union_set(order[i], order[i - 1]);
    }
  }
  for (const Eigen::Vector3i& triangle : mesh.triangles)
  {
    sets.union_set(triangle[0], triangle[1]);
    sets.union_set(triangle[1], triangle[2]);
  }
  for (int vertex = 0; vertex < count; ++vertex)
  {
    order[vertex] = sets.find_set(vertex);
  }
  return order;
}

std::vector<MeshComponent> componentsOf(const TriangleMesh& mesh)
{
  const std::vector<int> roots = componentRoots(mesh);
  std::vector<int> numbers(mesh.vertices.size(), -1);
  std::vector<MeshComponent> components;
  const auto add = [&](const Eigen::Vector3i& triangle)
  {
    const Eigen::Vector3f &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]],
                          &c = mesh.vertices[triangle[2]];
    const Eigen::Vector3d across = (b - a).cast<double>().cross((c - a).cast<double>());
    const double area = 0.5 * across.norm();
    if (!(area > 0.0))
    {
      return;
    }
    int& number = numbers[roots[triangle[0]]];
    if (number < 0)
    {
      number = static_cast<int>(components.size());
      components.emplace_back();
    }
    MeshComponent& component = components[number];
    ++component.triangles;
    component.area += area;
    component.bounds.extend(a).extend(b).extend(c);
    if (area > component.largestArea)
    {
      component.largestArea = area;
      component.corner = a.cast<double>();
      component.normal = across.normalized();
    }
  };
  std::for_each(mesh.triangles.begin(), mesh.triangles.end(), add);
  for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex)
  {
    if (const int number = numbers[roots[vertex]]; number >= 0)
    {
      MeshComponent& component = components[number];
      const double height = std::abs(component.normal.dot(mesh.vertices[vertex].cast<double>() - component.corner));
      component.isPlane = component.isPlane && height <= Flat * component.diagonal();
    }
  }
  std::sort(components.begin(), components.end(),
    [](const MeshComponent& a, const MeshComponent& b) { return a.area > b.area; });
  return components;
}

/// Moves planes that are far larger than all that is no plane out of the components.
std::vector<MeshComponent> takeLargePlanes(std::vector<MeshComponent>& components)
{
  Eigen::AlignedBox3f rest;
  for (const MeshComponent& component : components)
  {
    rest.extend(component.isPlane ? Eigen::AlignedBox3f() : component.bounds);
  }
  const double most = LargePlane * (rest.isEmpty() ? 0.0 : rest.diagonal().norm());
  const auto planes = std::stable_partition(components.begin(), components.end(),
    [&](const MeshComponent& component) { return most == 0.0 || !component.isPlane || component.diagonal() <= most; });
  const std::vector<MeshComponent> taken(planes, components.end());
  components.erase(planes, components.end());
  return taken;
}

/// What is not near the component of the largest area, or near what is near that.
std::vector<MeshComponent> farComponents(std::vector<MeshComponent> left)
{
  Eigen::AlignedBox3f body = left.front().bounds;
  for (std::size_t before = left.size() + 1; left.size() < before;)
  {
    before = left.size();
    std::vector<MeshComponent> far;
    for (const MeshComponent& component : left)
    {
      if (body.exteriorDistance(component.bounds) <= FarOff * body.diagonal().norm())
      {
        body.extend(component.bounds);
      }
      else
      {
        far.push_back(component);
      }
    }
    left.swap(far);
  }
  return left;
}

std::string lengths(const Eigen::Vector3f& values, const std::string& between)
{
  std::string text;
  for (const float value : values)
  {
    char number[32];
    std::snprintf(number, sizeof number, "%.*g", static_cast<int>(FewDigits), value + 0.0f);
    text += (text.empty() ? "" : between) + number;
  }
  return text;
}

std::string inWords(const MeshComponent& component, const std::string& what, const std::string& unit)
{
  return "a component of " + std::to_string(component.triangles) +
         (component.triangles == 1 ? " triangle, " : " triangles, ") + what + ", " +
         lengths(component.bounds.sizes(), " x ") + " large at (" + lengths(component.bounds.center(), ", ") + ") in " +
         unit;
}
}

std::vector<std::string> strayComponents(const TriangleMesh& mesh, const std::string& unit)
{
  const auto isNumber = [](const Eigen::Vector3f& vertex) { return vertex.allFinite(); };
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), isNumber))
  {
    return {}; // training refuses it
  }
  std::vector<MeshComponent> components = componentsOf(mesh);
  if (components.size() < 2)
  {
    return {};
  }
  auto told = mapped<std::string>(takeLargePlanes(components),
    [&](const MeshComponent& plane) { return inWords(plane, "a plane far larger than the rest", unit); });
  for (const MeshComponent& component : farComponents(std::move(components)))
  {
    told.push_back(inWords(component, "far off the rest", unit));
  }
  if (told.size() > MostTold)
  {
    const std::size_t more = told.size() - MostTold;
    told.resize(MostTold);
    told.push_back(std::to_string(more) + " more far off the rest, or far larger");
  }
  return told;
}

std::string strayReport(const std::string& path, const TriangleMesh& mesh, const std::string& unit)
{
  std::string text;
  for (const std::string& component : strayComponents(mesh, unit))
  {
    text += (text.empty() ? "The CAD file '" + path + "' holds " : "; ") + component;
  }
  return text.empty() ? text : text + ": if it is not of the part, export the part without it.";
}
}
