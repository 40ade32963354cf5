// SPDX-License-Identifier: BSD-3-Clause
// The bracket and scans as the entry points have them.
#pragma once

#include "TestScene.h"
#include "meam.h"
#include "scene/OrganizedCloud.h"

#include <memory>

namespace api
{
inline meam::Model bracketModel() { return meam::Model(std::make_shared<const meam::TrainedModel>(scenes::bracket())); }

/// 60 x 40 x 15 mm; its longer leg is 12 mm wide.
inline meam::Mesh bracketMesh(float scale = 1.0f)
{
  meam::TriangleMesh mesh = parts::lBracket();
  for (auto& vertex : mesh.vertices)
  {
    vertex *= scale;
  }
  return { mesh.vertices, mesh.triangles };
}

inline meam::Scan scanOf(const meam::OrganizedCloud& cloud)
{
  meam::Scan scan;
  scan.width = cloud.width;
  scan.height = cloud.height;
  scan.points = cloud.points;
  return scan;
}
}
