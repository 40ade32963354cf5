// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/VoteScore.h"

#include "baselines/BaselineSettings.h"
#include "TestScene.h"

/// Three poses of one place, of which one is turned by 20 degrees, and one elsewhere: 5 + 3, 3 + 5, 4 and 6 votes.
TEST(VoteScore, VotesOfPosesThatAgreeAddUp)
{
  const auto& truth = scenes::threeCopies();
  meam::Poses poses{ scenes::displaced(truth[0], 0.0, 0.0), scenes::displaced(truth[0], 1.0, 5.0),
    scenes::displaced(truth[0], 0.0, 20.0), scenes::displaced(truth[1], 0.0, 0.0) };
  const int votes[] = { 5, 3, 4, 6 };
  for (int i = 0; i < 4; ++i)
  {
    poses[i].votes = votes[i];
  }
  const meam::Poses scored =
    scenes::verify(poses, scenes::copiesScene(), scenes::bracket(), meam::votesVerificationSettings());
  ASSERT_EQ(scored.size(), 4u);
  const double scores[] = { 1.0, 1.0, 6.0 / 8.0, 4.0 / 8.0 };
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_DOUBLE_EQ(scored[i].score, scores[i]);
    EXPECT_EQ(scored[i].votes, static_cast<int>(std::lround(8 * scores[i])));
    EXPECT_EQ(scored[i].probability, 0.0) << "none is known";
  }
}
