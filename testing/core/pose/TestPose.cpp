// SPDX-License-Identifier: BSD-3-Clause
#include "pose/Pose.h"

#include "TestParts.h"
#include "base/Error.h"

namespace
{
/// Half turns about an axis beside the middle.
meam::Symmetries halfTurn()
{
  meam::Symmetries symmetries;
  symmetries.discrete = { meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI, { 1, 2, 3 }) };
  return symmetries;
}

meam::Pose at(const Eigen::Isometry3d& T)
{
  meam::Pose pose;
  pose.T_scene_model = T;
  return pose;
}
}

TEST(Pose, ComesBackFromTheLocalFrame)
{
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k)
  {
    const Eigen::Isometry3d T_local_scene = parts::motion(random, 800.0);
    meam::Pose pose = at(parts::motion(random, 50.0));
    pose.score = 0.25;
    pose.votes = 7;
    pose.fit.covariance.diagonal() << 1, 2, 3, 4, 5, 6;
    const meam::Pose local = meam::toLocalFrame({ pose }, T_local_scene, {}).at(0);
    EXPECT_TRUE(local.T_scene_model.isApprox(T_local_scene * pose.T_scene_model, 1e-12));
    const meam::Pose back = meam::toSceneFrame({ local }, T_local_scene, {}).at(0);
    EXPECT_TRUE(back.T_scene_model.isApprox(pose.T_scene_model, 1e-12));
    EXPECT_TRUE(back.fit.covariance.isApprox(pose.fit.covariance, 1e-12));
    EXPECT_EQ(back.score, 0.25);
    EXPECT_EQ(back.votes, 7);
  }
}

TEST(Pose, OfEqualOnesTheOneTurnedLeastIsTaken)
{
  const meam::Symmetries symmetries = halfTurn();
  std::mt19937 random(4);
  for (int k = 0; k < 20; ++k)
  {
    const Eigen::Isometry3d T_local_scene = parts::motion(random, 800.0);
    const Eigen::Isometry3d T = parts::motion(random, 50.0), equal = T * symmetries.discrete[0];
    const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
    const meam::Poses local = meam::toLocalFrame({ at(T), at(equal) }, T_local_scene, symmetries);
    EXPECT_TRUE(local[0].T_scene_model.isApprox(local[1].T_scene_model, 1e-9));
    EXPECT_LE(meam::rotationError(local[0].T_scene_model, identity),
      std::min(meam::rotationError(T_local_scene * T, identity), meam::rotationError(T_local_scene * equal, identity)) +
        1e-9);
    const Eigen::Isometry3d back = meam::toSceneFrame(local, T_local_scene, symmetries)[0].T_scene_model;
    const bool isFirst = meam::rotationError(T, identity) <= meam::rotationError(equal, identity);
    EXPECT_TRUE(back.isApprox(isFirst ? T : equal, 1e-9));
  }
}

TEST(Pose, InTheLocalFrameIsTheSameWhereverTheSceneLies)
{
  const meam::Symmetries symmetries = halfTurn();
  std::mt19937 random(5);
  const Eigen::Isometry3d motion = parts::motion(random, 800.0);
  const Eigen::Isometry3d here = parts::motion(random, 100.0), there = here * motion.inverse();
  for (int k = 0; k < 20; ++k)
  {
    const Eigen::Isometry3d T = parts::motion(random, 50.0);
    const Eigen::Isometry3d one = meam::toLocalFrame({ at(T) }, here, symmetries)[0].T_scene_model;
    for (const Eigen::Isometry3d& moved : { motion * T, motion * T * symmetries.discrete[0] })
    {
      EXPECT_TRUE(meam::toLocalFrame({ at(moved) }, there, symmetries)[0].T_scene_model.isApprox(one, 1e-9));
    }
  }
}

TEST(Pose, OneThatIsNotFiniteIsAnError)
{
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  for (const int column : { 0, 3 })
  {
    meam::Pose pose;
    pose.T_scene_model.matrix()(0, column) = NAN;
    EXPECT_THROW(meam::toLocalFrame({ pose }, identity, {}), meam::Error);
  }
  EXPECT_TRUE(meam::toLocalFrame({}, identity, {}).empty());
}

TEST(Pose, AMotionTurnsACovariance)
{
  meam::Pose pose;
  pose.fit.covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  Eigen::Isometry3d quarter(Eigen::Translation3d(7, 8, 9));
  quarter.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ())); // x becomes y
  Eigen::Matrix<double, 6, 1> expected;
  expected << 2, 1, 3, 5, 4, 6;
  EXPECT_TRUE(meam::moved(pose, quarter).fit.covariance.diagonal().isApprox(expected, 1e-12));
}

TEST(Pose, InOneSentenceHowSureItIsThatPartsWereFound)
{
  meam::Poses poses;
  EXPECT_EQ(meam::describe(poses), "No part was found.");
  EXPECT_EQ(meam::doubtsOf(poses), meam::describe(poses));
  poses.resize(1);
  poses[0].probability = 0.314;
  EXPECT_EQ(
    meam::describe(poses), "Nothing sure was found: the likeliest of 1 pose is there with a probability of 31 %.");
  EXPECT_EQ(meam::doubtsOf(poses), meam::describe(poses));
  poses.resize(3);
  poses[2].probability = 0.5;
  EXPECT_EQ(meam::describe(poses), "1 of 3 poses is more likely there than not.");
  EXPECT_EQ(meam::doubtsOf(poses), "");
  poses[1].score = 0.9;
  EXPECT_EQ(meam::describe(poses), "2 of 3 poses are more likely there than not.") << "of a file with scores alone";
  // Methods that the paper compares itself with have no probabilities.
  poses = meam::Poses(2);
  poses[0].score = 1.0;
  EXPECT_EQ(meam::describe(poses), "2 poses came out; the method does not tell how likely a copy is there.");
  EXPECT_EQ(meam::doubtsOf(poses), "");
}

TEST(Pose, ThoseThatMoreSpeaksForComeFirst)
{
  meam::Pose pose, other;
  pose.score = 0.8;
  EXPECT_EQ(meam::probabilityOrScore(pose), 0.8) << "no probability is known";
  pose.probability = 0.5;
  EXPECT_EQ(meam::probabilityOrScore(pose), 0.5);
  pose.evidence = -1.0;
  other.evidence = -2.0;
  EXPECT_TRUE(meam::isBetter(pose, other));
  EXPECT_FALSE(meam::isBetter(other, pose));
  EXPECT_FALSE(meam::isBetter(pose, pose));
}

TEST(Pose, TheEllipsoidOfItsUncertaintyHasTheDeviationsOfTheTranslationAboutTheMiddle)
{
  meam::Pose pose;
  pose.T_scene_model.translate(Eigen::Vector3d(10, 20, 30));
  pose.T_scene_model.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  pose.fit.covariance.diagonal() << 9.0, 9.0, 9.0, 0.01, 0.04, 0.25; // scene axes
  const Eigen::Affine3d ellipsoid = meam::uncertaintyEllipsoid(pose, Eigen::Vector3d(5, 0, 0), 10.0);
  EXPECT_TRUE(ellipsoid.translation().isApprox(Eigen::Vector3d(10, 25, 30))) << ellipsoid.translation().transpose();
  const Eigen::Matrix3d shape = ellipsoid.linear() * ellipsoid.linear().transpose(); // the covariance, scaled
  EXPECT_TRUE(shape.isApprox(Eigen::Vector3d(1, 4, 25).asDiagonal().toDenseMatrix())) << shape;
}

TEST(Pose, TheEllipsoidIsTurnedAsTheErrorsAre)
{
  meam::Pose pose;
  const Eigen::Vector3d along = Eigen::Vector3d(1, 1, 0).normalized();
  pose.fit.covariance.bottomRightCorner<3, 3>() = along * along.transpose(); // errors along one axis alone
  const Eigen::Affine3d ellipsoid = meam::uncertaintyEllipsoid(pose, Eigen::Vector3d::Zero(), 2.0);
  const Eigen::Matrix3d shape = ellipsoid.linear() * ellipsoid.linear().transpose();
  EXPECT_TRUE(shape.isApprox(4.0 * along * along.transpose(), 1e-6)) << shape;
}
