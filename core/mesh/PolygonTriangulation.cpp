// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PolygonTriangulation.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr double FoldedLess = 0.99; // share of the area: rounded corners of a plane turn no diagonal

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The corners in the plane across their mean normal (Newell), in which they go counter-clockwise.
std::vector<Eigen::Vector2d> flattened(const std::vector<int>& corners, const Points& vertices)
{
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = vertices[corners.front()].cast<double>();
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Eigen::Vector3d from = vertices[corners[k]].cast<double>() - origin;
    const Eigen::Vector3d to = vertices[corners[(k + 1) % corners.size()]].cast<double>() - origin;
    normal += from.cross(to);
  }
  normal = normal.norm() > 0.0 ? normal.normalized().eval() : Eigen::Vector3d::UnitZ().eval();
  const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(corners.size());
  for (const int corner : corners)
  {
    const Eigen::Vector3d place = vertices[corner].cast<double>() - origin;
    flat.emplace_back(x.dot(place), y.dot(place));
  }
  return flat;
}

/// Whether a face of four corners that lie in no plane is less folded when it is cut between the second and the last:
/// its triangles are smaller then.
bool isFoldedLess(const std::vector<int>& corners, const Points& vertices)
{
  const auto area = [&](int a, int b, int c)
  {
    const Eigen::Vector3d origin = vertices[corners[a]].cast<double>();
    return (vertices[corners[b]].cast<double>() - origin).cross(vertices[corners[c]].cast<double>() - origin).norm();
  };
  return area(1, 2, 3) + area(1, 3, 0) < FoldedLess * (area(0, 1, 2) + area(0, 2, 3));
}

/// A face whose ears are cut off one by one.
class EarClipping
{
public:
  explicit EarClipping(std::vector<Eigen::Vector2d> flat)
    : Flat(std::move(flat))
  {
    const int count = static_cast<int>(this->Flat.size());
    for (int k = 0; k < count; ++k)
    {
      this->Next.push_back((k + 1) % count);
      this->Previous.push_back((k + count - 1) % count);
    }
    for (int k = 0; k < count; ++k)
    {
      if (!this->turnsLeft(k))
      {
        this->Reflex.push_back(k);
      }
    }
  }

  bool isConvex() const { return this->Reflex.empty(); }

  /// Calls take(before, ear, after) for each triangle.
  template <typename Take>
  void cut(const Take& take)
  {
    int left = static_cast<int>(this->Flat.size()), at = 0;
    for (int seen = 0; left > 3; ++seen)
    {
      // None is an ear of a face that crosses itself, or whose corners lie on a line.
      if (seen <= left && !this->isEar(at))
      {
        at = this->Next[at];
        continue;
      }
      const int before = this->Previous[at], after = this->Next[at];
      take(before, at, after);
      this->Next[before] = after;
      this->Previous[after] = before;
      eraseIf(this->Reflex, [&](int k) { return k == at || ((k == before || k == after) && this->turnsLeft(k)); });
      at = this->Next[after]; // slivers about one corner are avoided
      --left;
      seen = -1;
    }
    take(this->Previous[at], at, this->Next[at]);
  }

private:
  bool turnsLeft(int k) const
  {
    return cross(this->Flat[this->Previous[k]], this->Flat[k], this->Flat[this->Next[k]]) > 0.0;
  }

  bool isEar(int k) const
  {
    const Eigen::Vector2d &a = this->Flat[this->Previous[k]], &b = this->Flat[k], &c = this->Flat[this->Next[k]];
    if (!(cross(a, b, c) > 0.0))
    {
      return false;
    }
    return std::none_of(this->Reflex.begin(), this->Reflex.end(),
      [&](int other)
      {
        const Eigen::Vector2d& p = this->Flat[other];
        const bool isCorner = p == a || p == b || p == c; // where a slit leads to a hole, twice
        return !isCorner && cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0;
      });
  }

  std::vector<Eigen::Vector2d> Flat;
  std::vector<int> Next, Previous, Reflex;
};
}

void addPolygon(const std::vector<int>& corners, TriangleMesh& mesh)
{
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c)
  { mesh.triangles.emplace_back(corners[a], corners[b], corners[c]); };
  if (corners.size() > MostCorners)
  {
    throw Error("A face of the mesh has " + std::to_string(corners.size()) +
                " corners: cut it into triangles in the program that wrote it.");
  }
  if (corners.size() == 3)
  {
    add(0, 1, 2);
  }
  if (corners.size() <= 3)
  {
    return;
  }
  EarClipping clipping(flattened(corners, mesh.vertices));
  if (clipping.isConvex() && corners.size() == 4 && isFoldedLess(corners, mesh.vertices))
  {
    add(0, 1, 3);
    add(1, 2, 3);
    return;
  }
  if (clipping.isConvex())
  {
    for (std::size_t k = 2; k < corners.size(); ++k)
    {
      add(0, k - 1, k);
    }
    return;
  }
  clipping.cut([&](int before, int ear, int after) { add(before, ear, after); });
}
}
