// SPDX-License-Identifier: BSD-3-Clause
#include "model/MirrorImage.h"

#include "TestScene.h"

namespace
{
/// A plate with a block on one of its corners: no rotation takes it to its mirror image.
meam::TriangleMesh cornerBlock() { return parts::blockOnPlate(false); }
meam::TriangleMesh plainBox() { return parts::box({ 0.0f, 0.0f, 0.0f }, { 60.0f, 40.0f, 15.0f }); }
}

TEST(MirrorImage, APartWithAMirrorPlaneHasNone)
{
  EXPECT_EQ(scenes::trained<plainBox>().mirrorImage->of(scenes::trained<plainBox>()), nullptr);
}

TEST(MirrorImage, HasThePointsOfThePartMirrored)
{
  const meam::TrainedModel& model = scenes::trained<cornerBlock>();
  const meam::MirroredPart* mirrored = model.mirrorImage->of(model);
  ASSERT_NE(mirrored, nullptr);
  EXPECT_EQ(mirrored, model.mirrorImage->of(model)) << "it is made once";
  const meam::PointCloud& surface = model.surface;
  const meam::PointCloud& other = mirrored->model.surface;
  ASSERT_EQ(other.size(), surface.size());
  EXPECT_EQ(mirrored->model.edges.size(), model.edges.size());
  // Lengths stay, and of four points that span a volume its sign changes.
  const std::size_t a = 0, b = surface.size() / 3, c = surface.size() / 2, d = surface.size() - 1;
  const auto volume = [&](const meam::Points& p) { return (p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]); };
  EXPECT_NEAR((other.points[b] - other.points[a]).norm(), (surface.points[b] - surface.points[a]).norm(), 1e-4);
  ASSERT_GT(std::abs(volume(surface.points)), 100.0f);
  EXPECT_NEAR(volume(other.points), -volume(surface.points), 1e-4f * std::abs(volume(surface.points)));
  EXPECT_NEAR(other.normals[b].norm(), 1.0f, 1e-5f);
}

TEST(MirrorImage, LiesInOtherWaysAfterRigidMotions)
{
  const meam::TrainedModel& model = scenes::trained<cornerBlock>();
  const std::vector<Eigen::Isometry3d>& turns = model.mirrorImage->of(model)->turns;
  ASSERT_FALSE(turns.empty());
  EXPECT_TRUE(turns[0].isApprox(Eigen::Isometry3d::Identity(), 1e-6)) << "it is mirrored at the best plane";
  for (const Eigen::Isometry3d& turn : turns)
  {
    EXPECT_NEAR(turn.linear().determinant(), 1.0, 1e-9);
    EXPECT_TRUE((turn.linear() * turn.linear().transpose()).isApprox(Eigen::Matrix3d::Identity(), 1e-9));
    EXPECT_LT(turn.translation().norm(), 2.0 * model.diameter);
  }
}
