// SPDX-License-Identifier: BSD-3-Clause
// Picks of 20 copies in a simulated bin, a scan of 960 x 768 points, with 20 grasps each that come from above: jaws by
// their lengths, and the same as a mesh. One thread.
#include "pick/PickPlanning.h"
#include "simulation/BinScene.h"
#include "simulation/parts/SamplePart.h"

#include <benchmark/benchmark.h>

namespace
{
struct FullBin
{
  FullBin()
    : part(meam::makeSamplePart())
    , scene(meam::simulateBin(part))
  {
    for (const auto& instance : this->scene.instances)
    {
      this->poses.emplace_back();
      this->poses.back().T_scene_model = instance.T_scene_model;
      this->poses.back().probability = 1.0;
    }
    // Grasps all around every part's origin, so that some come from above however it lies.
    meam::Random random(1);
    for (int k = 0; k < 20; ++k)
    {
      const Eigen::Vector3d approach(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      meam::Grasp grasp;
      grasp.T_model_grasp = meam::graspFrame(-20.0 * approach.normalized(), approach, Eigen::Vector3d(1.0, 2.0, 3.0));
      grasp.width = 40.0;
      this->grasps.push_back(grasp);
    }
    const double thickness = 0.05 * 81.0; // of the walls, as the simulation has them
    this->bin.T_scene_bin.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    this->bin.T_scene_bin.translation().z() = 3.0 * this->scene.binSize;
    this->bin.size = Eigen::Vector3d(this->scene.binSize, this->scene.binSize, 50.0);
    this->bin.wall = thickness;
  }

  meam::TriangleMesh part;
  meam::BinScene scene;
  meam::Poses poses;
  meam::Grasps grasps;
  meam::Bin bin;
};

const FullBin& fullBin()
{
  static const FullBin bin;
  return bin;
}

void plan(benchmark::State& state, const meam::Gripper& gripper)
{
  const FullBin& bin = fullBin();
  meam::PlanSettings settings; // that leave most of the work to do
  settings.maximumCovered = 100.0;
  settings.maximumTilt = 90.0;
  meam::PickPlanner planner(bin.part, {}, bin.grasps, gripper, settings);
  int possible = 0;
  int looked = 0; // whose clearance had to be found
  for (auto _ : state)
  {
    const meam::Picks picks = planner.plan(bin.poses, bin.scene.cloud, bin.bin);
    possible = looked = 0;
    for (const meam::Pick& pick : picks)
    {
      possible += pick.possible();
      looked += pick.possible() || pick.obstruction >= meam::PickObstruction::Bin;
    }
  }
  state.counters["possible"] = possible;
  state.counters["looked at"] = looked;
}

void PickPlanning(benchmark::State& state) { plan(state, {}); }
BENCHMARK(PickPlanning)->UseRealTime()->Unit(benchmark::kMillisecond);

void PickPlanningWithMesh(benchmark::State& state)
{
  meam::Gripper gripper;
  gripper.mesh = meam::meshOf({}, fullBin().grasps.front());
  plan(state, gripper);
}
BENCHMARK(PickPlanningWithMesh)->UseRealTime()->Unit(benchmark::kMillisecond);
}
