// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// Points in balls in balls: finds those near to a surface without a look at the others.
class SphereTree
{
public:
  explicit SphereTree(Points points);

  const Points& points() const { return this->Sorted; }

  /// Calls visit(index into points) for the points of all balls with isNear(centre, radius).
  template <typename IsNear, typename Visitor>
  void forEachNear(IsNear&& isNear, Visitor&& visit) const
  {
    // A ball follows its parent; `next` is the first one that is not inside it.
    for (std::size_t i = 0; i < this->Balls.size();)
    {
      const Ball& ball = this->Balls[i];
      if (!isNear(ball.centre, ball.radius))
      {
        i = ball.next;
        continue;
      }
      for (int k = ball.begin; k < ball.end; ++k)
      {
        visit(k);
      }
      ++i;
    }
  }

private:
  struct Ball
  {
    Eigen::Vector3f centre;
    float radius;
    std::size_t next;
    int begin; ///< points of a ball without balls inside, otherwise none
    int end;
  };
  void add(int begin, int end);

  Points Sorted;
  std::vector<Ball> Balls;
};
}
