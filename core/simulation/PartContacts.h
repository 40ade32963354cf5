// SPDX-License-Identifier: BSD-3-Clause
// A part of any shape in Bullet. Heavy: only for files that include Bullet anyway.
#pragma once

#include "simulation/SignedDistanceGrid.h"
#include "simulation/SphereTree.h"

#include <btBulletDynamicsCommon.h>

namespace meam
{
/// A rigid part as Bullet's collision shape: points on its surface and the distances from it. Two parts touch
/// where points of either are at the surface of the other, so that rings catch and cups nest. Lengths are in
/// the part's diameter, in the frame of its mass.
class PartShape : public btCollisionShape
{
public:
  PartShape(Points surfacePoints, SignedDistanceGrid distances, double skin);

  const SphereTree& points() const { return this->SurfacePoints; }
  const SignedDistanceGrid& distances() const { return this->Distances; }
  /// At this distance from the surface another part rests.
  float skin() const { return this->Skin; }
  /// Of a ball around the centre of mass.
  float radius() const { return this->Radius; }

  void getAabb(const btTransform& T_world_body, btVector3& low, btVector3& high) const override;
  void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); } // known beforehand
  void setLocalScaling(const btVector3&) override {}
  const btVector3& getLocalScaling() const override { return this->Scaling; }
  void setMargin(btScalar) override {}
  btScalar getMargin() const override { return 0.0; }
  const char* getName() const override { return "Part"; }

private:
  SphereTree SurfacePoints;
  SignedDistanceGrid Distances;
  float Skin;
  float Radius;
  Eigen::AlignedBox3f Box;
  btVector3 Scaling = btVector3(1.0, 1.0, 1.0);
};

/// Makes the dispatcher find the contacts of parts with each other and with Bullet's planes.
void registerPartContacts(btCollisionDispatcher& dispatcher);
}
