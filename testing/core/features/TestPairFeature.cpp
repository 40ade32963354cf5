// SPDX-License-Identifier: BSD-3-Clause
#include "features/PairFeature.h"

#include "TestParts.h"
#include "pose/Pose.h"

using meam::PairFeature;
using meam::PairFeatureKind;

namespace
{
constexpr double Degree = M_PI / 180.0;

Eigen::Vector3f unit(std::mt19937& random)
{
  const auto number = [&] { return random() / 2147483648.0f - 1.0f; };
  return Eigen::Vector3f(number(), number(), number() + 0.01f).normalized();
}
}

TEST(PairFeature, ByHand)
{
  // d = (0, 3, 4). A tangent along x is across it; a normal has a sign.
  const struct
  {
    PairFeatureKind kind;
    Eigen::Vector3f reference, referred;
    double referenceAngle, referredAngle;
  } cases[] = { { PairFeatureKind::Paper, { 1, 0, 0 }, { 0, 0, 1 }, 90 * Degree, std::acos(0.8) },
    { PairFeatureKind::Surface, { 0, 0, -1 }, { 0, 1, 0 }, std::acos(-0.8), std::acos(0.6) },
    { PairFeatureKind::Surface, { 0, 0, 1 }, { 0, 1, 0 }, std::acos(0.8), std::acos(0.6) } };
  for (const auto& [kind, reference, referred, referenceAngle, referredAngle] : cases)
  {
    const PairFeature feature = meam::pairFeature(kind, { 1, 1, 1 }, reference, { 1, 4, 5 }, referred);
    EXPECT_FLOAT_EQ(feature.distance, 5.0f);
    EXPECT_NEAR(feature.referenceAngle, referenceAngle, 1e-6);
    EXPECT_NEAR(feature.referredAngle, referredAngle, 1e-6);
    EXPECT_NEAR(feature.betweenAngle, 90 * Degree, 1e-6);
  }
}

TEST(PairFeature, OrientedTellsObtuseAnglesAndMirrorImages)
{
  // Along d = x both tangents open to 45 degrees, one to +y and one to -y: 90 degrees apart. With one
  // of them turned to +z the three vectors have a hand.
  const float s = std::sqrt(0.5f);
  const auto apart = meam::pairFeature(PairFeatureKind::Oriented, { 0, 0, 0 }, { s, s, 0 }, { 2, 0, 0 }, { s, -s, 0 });
  EXPECT_NEAR(apart.betweenAngle, 90 * Degree, 1e-3);
  // Steep tangents to both sides: 160 degrees apart when oriented, 20 when folded.
  const float c = std::cos(80 * Degree);
  const float n = std::sin(80 * Degree);
  const auto wide = meam::pairFeature(PairFeatureKind::Oriented, { 0, 0, 0 }, { c, n, 0 }, { 2, 0, 0 }, { c, -n, 0 });
  EXPECT_NEAR(wide.betweenAngle, 160 * Degree, 1e-4);
  const auto folded = meam::pairFeature(PairFeatureKind::Paper, { 0, 0, 0 }, { c, n, 0 }, { 2, 0, 0 }, { c, -n, 0 });
  EXPECT_NEAR(folded.betweenAngle, 20 * Degree, 1e-4);

  const auto left = meam::pairFeature(PairFeatureKind::Oriented, { 0, 0, 0 }, { s, s, 0 }, { 2, 0, 0 }, { s, 0, s });
  const auto right = meam::pairFeature(PairFeatureKind::Oriented, { 0, 0, 0 }, { s, s, 0 }, { 2, 0, 0 }, { s, 0, -s });
  EXPECT_TRUE(left.rightHanded); // det[(1,1,0), (1,0,1), (1,0,0)] = 1
  EXPECT_FALSE(right.rightHanded);
}

TEST(PairFeature, NeitherMotionNorTheSignOfATangentChangesIt)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Eigen::Vector3f pr = 50.0f * unit(random), pi = 50.0f * unit(random), tr = unit(random), ti = unit(random);
    const Eigen::Isometry3f T = parts::motion(random, 100.0).cast<float>();
    const Eigen::Vector3f d = (pi - pr).normalized();
    for (const auto kind : { PairFeatureKind::Paper, PairFeatureKind::Oriented, PairFeatureKind::Surface })
    {
      const PairFeature expected = meam::pairFeature(kind, pr, tr, pi, ti);
      const bool isOfLines = meam::isOfLines(kind);
      for (int signs = 0; signs < (isOfLines ? 4 : 1); ++signs)
      {
        const PairFeature found = meam::pairFeature(kind, T * pr, (signs & 1 ? -1.0f : 1.0f) * (T.linear() * tr),
          T * pi, (signs & 2 ? -1.0f : 1.0f) * (T.linear() * ti));
        EXPECT_NEAR(found.distance, expected.distance, 1e-4);
        EXPECT_NEAR(found.referenceAngle, expected.referenceAngle, 2e-3);
        EXPECT_NEAR(found.referredAngle, expected.referredAngle, 2e-3);
        if (!isOfLines || (std::abs(tr.dot(d)) > 1e-3f && std::abs(ti.dot(d)) > 1e-3f))
        {
          EXPECT_NEAR(found.betweenAngle, expected.betweenAngle, 2e-3);
          EXPECT_TRUE(found.rightHanded == expected.rightHanded || std::abs(tr.cross(ti).dot(d)) <= 1e-3f);
        }
      }
    }
  }
}

TEST(PairFeature, QuantizerCutsAtTheSteps)
{
  const meam::PairFeatureQuantizer paper(PairFeatureKind::Paper, 7.0, 10 * Degree, 100.0);
  EXPECT_EQ(paper.numberOfKeys(), 15 * 9 * 9 * 9);
  EXPECT_EQ(paper.key({ 0.0f, 0.0f, 0.0f, 0.0f, false }), 0);
  // Distance 20 is in step 2; angles 25, 35 and 85 degrees are in steps 2, 3 and 8.
  const auto angle = [](double degrees) { return static_cast<float>(degrees * Degree); };
  EXPECT_EQ(paper.key({ 20.0f, angle(25), angle(35), angle(85), false }), ((2 * 9 + 2) * 9 + 3) * 9 + 8);
  // The right angle belongs to the last step; beyond d_max there is no key.
  EXPECT_EQ(paper.key({ 20.0f, angle(90), angle(90), angle(90), false }), ((2 * 9 + 8) * 9 + 8) * 9 + 8);
  EXPECT_EQ(paper.key({ 100.0f, 0.0f, 0.0f, 0.0f, false }), 14 * 9 * 9 * 9);
  EXPECT_EQ(paper.key({ 100.1f, 0.0f, 0.0f, 0.0f, false }), -1);
  EXPECT_EQ(paper.key({ 1e9f, 0.0f, 0.0f, 0.0f, false }), -1);

  const meam::PairFeatureQuantizer oriented(PairFeatureKind::Oriented, 7.0, 10 * Degree, 100.0);
  EXPECT_EQ(oriented.numberOfKeys(), 15 * 9 * 9 * 18 * 2);
  EXPECT_EQ(oriented.key({ 20.0f, angle(25), angle(35), angle(175), true }), (((2 * 9 + 2) * 9 + 3) * 18 + 17) * 2 + 1);

  const meam::PairFeatureQuantizer surface(PairFeatureKind::Surface, 7.0, 10 * Degree, 100.0);
  EXPECT_EQ(surface.numberOfKeys(), 15 * 18 * 18 * 18);
  EXPECT_EQ(surface.key({ 20.0f, angle(125), angle(35), angle(175), false }), ((2 * 18 + 12) * 18 + 3) * 18 + 17);
}

TEST(PairFeature, FramesAndAnglesGiveThePoseBack)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Eigen::Vector3f mr = 50.0f * unit(random);
    const Eigen::Vector3f mi = 50.0f * unit(random);
    const Eigen::Vector3f tm = unit(random);
    const Eigen::Isometry3d T = parts::motion(random, 100.0);
    const Eigen::Isometry3f Tf = T.cast<float>();
    const Eigen::Vector3f ts = (trial % 2 == 0 ? 1.0f : -1.0f) * (Tf.linear() * tm);
    const meam::PairFrame model(mr, tm);
    const meam::PairFrame scene(Tf * mr, ts);
    const Eigen::Vector3f si = Tf * mi;
    if (std::abs(tm.dot((mi - mr).normalized())) < 1e-3f || (mi - mr).cross(tm).norm() < 1.0f)
    {
      continue; // the sign, or the turn about the tangent, is not determined
    }
    const bool flip = model.against(mi) != scene.against(si);
    EXPECT_EQ(flip, trial % 2 != 0);
    const double alpha = flip ? scene.angleOf(si) + model.angleOf(mi) : scene.angleOf(si) - model.angleOf(mi);
    const Eigen::Isometry3d found = meam::alignFrames(model, scene, flip, alpha);
    EXPECT_LT(meam::rotationError(found, T), 0.05);
    EXPECT_LT((found * mi.cast<double>() - T * mi.cast<double>()).norm(), 0.02);
    EXPECT_NEAR(found.linear().determinant(), 1.0, 1e-12);
    EXPECT_TRUE((found.linear().transpose() * found.linear()).isIdentity(1e-12));
  }
}
