// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Gripper.h"

#include "base/Error.h"
#include "base/Range.h"

#include <cmath>

namespace meam
{
namespace
{
constexpr int RoundSides = 24;       // of a cylinder to look at
constexpr double LeastLength = 1e-3; // mm, of a gripper's

void requireLength(const char* name, double length)
{
  requireWithin(std::string("gripper's ") + name, length, LeastLength, Unbounded, " mm");
}

/// A prism along z around the middle: the corners of its outline one after the other, counter-clockwise.
void addPrism(TriangleMesh& mesh, const GripperPiece& piece, const std::vector<Eigen::Vector2d>& outline)
{
  const int sides = static_cast<int>(outline.size());
  const int first = static_cast<int>(mesh.vertices.size());
  for (const double end : { -0.5, 0.5 })
  {
    for (const auto& corner : outline)
    {
      const Eigen::Vector3d place(corner.x(), corner.y(), end);
      mesh.vertices.push_back((piece.middle + piece.size.cwiseProduct(place)).cast<float>());
    }
  }
  for (int k = 0; k < sides; ++k)
  {
    const int next = (k + 1) % sides;
    mesh.triangles.emplace_back(first + k, first + next, first + sides + k);
    mesh.triangles.emplace_back(first + next, first + sides + next, first + sides + k);
    if (k >= 2)
    {
      mesh.triangles.emplace_back(first, first + k, first + k - 1);
      mesh.triangles.emplace_back(first + sides, first + sides + k - 1, first + sides + k);
    }
  }
}
}

std::vector<GripperPiece> piecesOf(const Gripper& gripper, const Grasp& grasp, double wayIn)
{
  std::vector<GripperPiece> pieces;
  if (!gripper.mesh.triangles.empty())
  {
    return pieces;
  }
  const auto add = [&](bool round, double x, double fromZ, double toZ, double sizeX, double sizeY)
  {
    const double from = fromZ - wayIn;
    pieces.push_back({ round, { x, 0.0, 0.5 * (from + toZ) }, { sizeX, sizeY, toZ - from } });
  };
  if (gripper.kind == GraspKind::Suction)
  {
    add(true, 0.0, -gripper.cupLength, 0.0, gripper.cupDiameter, gripper.cupDiameter);
    add(true, 0.0, -gripper.cupLength - gripper.bodyLength, -gripper.cupLength, gripper.bodyWidth, gripper.bodyWidth);
    return pieces;
  }
  const double x = 0.5 * grasp.width + gripper.jawClearance + 0.5 * gripper.fingerThickness;
  const double body = gripper.tipLength - gripper.fingerLength;
  for (const double side : { -1.0, 1.0 })
  {
    add(false, side * x, body, gripper.tipLength, gripper.fingerThickness, gripper.fingerWidth);
  }
  add(false, 0.0, body - gripper.bodyLength, body, gripper.opening + 2.0 * gripper.fingerThickness, gripper.bodyWidth);
  return pieces;
}

std::vector<GripperPiece> betweenJaws(const Gripper& gripper, const Grasp& grasp)
{
  if (gripper.kind == GraspKind::Suction || !gripper.mesh.triangles.empty())
  {
    return {};
  }
  const double width = grasp.width + 2.0 * gripper.jawClearance;
  return { { false, Eigen::Vector3d::Zero(), { width, gripper.fingerWidth, 2.0 * gripper.tipLength } } };
}

TriangleMesh meshOf(const GripperPiece& piece)
{
  std::vector<Eigen::Vector2d> outline{ { -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } };
  if (piece.round)
  {
    outline.clear();
    for (int k = 0; k < RoundSides; ++k)
    {
      const double angle = 2.0 * M_PI * k / RoundSides;
      outline.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle));
    }
  }
  TriangleMesh mesh;
  addPrism(mesh, piece, outline);
  return mesh;
}

TriangleMesh meshOf(const Gripper& gripper, const Grasp& grasp)
{
  TriangleMesh mesh = gripper.mesh;
  for (const GripperPiece& piece : piecesOf(gripper, grasp)) // none of a mesh
  {
    const TriangleMesh faces = meshOf(piece);
    const Eigen::Vector3i first = Eigen::Vector3i::Constant(static_cast<int>(mesh.vertices.size()));
    mesh.vertices.insert(mesh.vertices.end(), faces.vertices.begin(), faces.vertices.end());
    for (const auto& triangle : faces.triangles)
    {
      mesh.triangles.push_back(triangle + first);
    }
  }
  return mesh;
}

void requireGripper(const Gripper& gripper)
{
  if (!gripper.mesh.triangles.empty() || !gripper.mesh.vertices.empty())
  {
    requireMesh(gripper.mesh);
    return;
  }
  const bool jaws = gripper.kind == GraspKind::Parallel;
  requireLength("body length", gripper.bodyLength);
  requireLength("body width", gripper.bodyWidth);
  if (jaws)
  {
    requireLength("opening", gripper.opening);
    requireLength("finger width", gripper.fingerWidth);
    requireLength("finger thickness", gripper.fingerThickness);
    requireLength("finger length", gripper.fingerLength);
    requireLength("tip length", gripper.tipLength);
    requireWithin("gripper's jaw clearance", gripper.jawClearance, 0.0, Unbounded, " mm");
  }
  else
  {
    requireLength("cup diameter", gripper.cupDiameter);
    requireLength("cup length", gripper.cupLength);
  }
  if (jaws && gripper.tipLength >= gripper.fingerLength)
  {
    throw Error("The gripper's tips reach farther beyond the grasp than its fingers are long.");
  }
}
}
