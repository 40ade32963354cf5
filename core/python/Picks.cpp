// SPDX-License-Identifier: BSD-3-Clause
#include "Conversion.h"
#include "picks.h"

namespace meamPython
{
namespace
{
using namespace meam;
using Unlocked = py::call_guard<py::gil_scoped_release>;

constexpr const char* Kinds[] = { "parallel", "suction" };
constexpr const char* Turns[] = { "none", "approach", "closing" };

Eigen::Isometry3d frameOf(const Eigen::Matrix4d& matrix)
{
  Eigen::Isometry3d frame;
  frame.matrix() = matrix;
  return frame;
}

void bindGrasps(py::module_& module)
{
  py::class_<Grasp>(module, "Grasp", "Where a gripper holds the part.")
    .def_readwrite("name", &Grasp::name)
    .def_property_readonly(
      "kind", [](const Grasp& grasp) { return Kinds[static_cast<int>(grasp.kind)]; }, "parallel or suction.")
    .def_property_readonly(
      "transform", [](const Grasp& grasp) { return grasp.T_model_grasp.matrix(); },
      "4 x 4, in the part's coordinates (mm): z the way in, x along which jaws close.")
    .def_readonly("width", &Grasp::width, "mm, of the part between the jaws; 0 for a cup.")
    .def_property_readonly(
      "free_turn", [](const Grasp& grasp) { return Turns[static_cast<int>(grasp.freeTurn)]; },
      "none, approach or closing: the axis about which any turn holds as well.")
    .def_readonly("quality", &Grasp::quality, "[0, 1], how well it holds.");
  module.def("load_grasps", &loadGrasps, Unlocked());
  module.def("save_grasps", &saveGrasps, Unlocked());
  module.def("load_robot_frame", [](const std::string& path) { return loadRobotFrame(path).matrix().eval(); });
  module.def("prepare_mesh", &prepareMesh, Unlocked());
  module.def("gripper_mesh", &gripperMesh);
  module.def("propose_grasps",
    [](const Model& model, const Mesh& part, const GripperModel& gripper, const ProposeSettings& settings)
    {
      return withoutLock(
        [&](const Progress& progress) { return proposeGrasps(model, part, gripper, settings, progress); });
    });
}

void bindSettings(py::module_& module)
{
  py::class_<GripperModel>(module, "GripperModel")
    .def(py::init<>())
    .def("use_cup", [](GripperModel& gripper) { gripper.kind = GraspKind::Suction; })
    .def_readwrite("opening", &GripperModel::opening)
    .def_readwrite("jawClearance", &GripperModel::jawClearance)
    .def_readwrite("fingerWidth", &GripperModel::fingerWidth)
    .def_readwrite("fingerThickness", &GripperModel::fingerThickness)
    .def_readwrite("fingerLength", &GripperModel::fingerLength)
    .def_readwrite("tipLength", &GripperModel::tipLength)
    .def_readwrite("bodyLength", &GripperModel::bodyLength)
    .def_readwrite("bodyWidth", &GripperModel::bodyWidth)
    .def_readwrite("cupDiameter", &GripperModel::cupDiameter)
    .def_readwrite("cupLength", &GripperModel::cupLength)
    .def_readwrite("mesh", &GripperModel::mesh);
  py::class_<ProposeSettings>(module, "ProposeSettings")
    .def(py::init<>())
    .def_readwrite("maximumGrasps", &ProposeSettings::maximumGrasps)
    .def_readwrite("frictionAngle", &ProposeSettings::frictionAngle)
    .def_readwrite("spread", &ProposeSettings::spread);
  py::class_<PlanSettings>(module, "PlanSettings")
    .def(py::init<>())
    .def_readwrite("safetyMargin", &PlanSettings::safetyMargin)
    .def_readwrite("wayIn", &PlanSettings::wayIn)
    .def_readwrite("minimumProbability", &PlanSettings::minimumProbability)
    .def_readwrite("rotationCounts", &PlanSettings::rotationCounts)
    .def_readwrite("maximumTilt", &PlanSettings::maximumTilt)
    .def_readwrite("maximumCovered", &PlanSettings::maximumCovered)
    .def_readwrite("turnStep", &PlanSettings::turnStep)
    .def_readwrite("tolerance", &PlanSettings::tolerance);
}

void bindPlanning(py::module_& module)
{
  py::class_<Bin>(module, "Bin", "An open box that parts lie in; z goes up from the middle of its floor.")
    .def(py::init(
      [](const Eigen::Matrix4d& transform, const Eigen::Vector3d& size, double wall) {
        return Bin{ frameOf(transform), size, wall };
      }))
    .def_property_readonly(
      "transform", [](const Bin& bin) { return bin.T_scene_bin.matrix(); }, "4 x 4, to the scan's coordinates, mm.")
    .def_readonly("size", &Bin::size, "mm, inside: along x, along y, height of the walls.")
    .def_readonly("wall", &Bin::wall, "mm, thickness of the walls and the floor.");
  py::class_<Workplace>(module, "Workplace")
    .def(py::init<>())
    .def_readwrite("has_bin", &Workplace::hasBin)
    .def_readwrite("bin", &Workplace::bin)
    .def("set_robot_frame",
      [](Workplace& place, const Eigen::Matrix4d& T_robot_camera) { place.T_robot_camera = frameOf(T_robot_camera); });
  py::class_<PlannedPick>(module, "Pick", "One grasp of one copy.")
    .def_readonly("possible", &PlannedPick::possible)
    .def_readonly("reason", &PlannedPick::reason, "What is against it; empty: nothing.")
    .def_property_readonly(
      "transform", [](const PlannedPick& pick) { return pick.T_scan_grasp.matrix(); },
      "4 x 4, takes the gripper's coordinates to the scan's, mm: z the way in.")
    .def_property_readonly(
      "robot_transform",
      [](const PlannedPick& pick)
      { return pick.T_robot_grasp ? py::cast(pick.T_robot_grasp->matrix().eval()) : py::object(py::none()); },
      "The same in the robot's frame, where that is known.")
    .def_readonly("instance", &PlannedPick::instance, "Which of the poses, from 0.")
    .def_readonly("part", &PlannedPick::part, "Which of the types of part, from 0.")
    .def_readonly("grasp", &PlannedPick::grasp, "Which of the grasps of its type, from 0.")
    .def_readonly("name", &PlannedPick::graspName, "Of the grasp.")
    .def_readonly("width", &PlannedPick::width, "mm, of the part between the jaws.")
    .def_readonly("clearance", &PlannedPick::clearance, "mm from all but the part, on the way in.")
    .def_readonly("reach", &PlannedPick::reach, "mm from the bin's rim down to the grasp.")
    .def_readonly("tilt", &PlannedPick::tilt, "Degrees between the way in and straight down.")
    .def_readonly("covered", &PlannedPick::covered, "[0, 1] of the part, from above.")
    .def_readonly("score", &PlannedPick::score, "[0, 1], by which possible picks are ordered.");
  py::class_<PickPlan>(module, "PickPlan")
    .def_readonly("picks", &PickPlan::picks)
    .def_readonly("report", &PickPlan::report)
    .def_readonly("advice", &PickPlan::advice)
    .def_readonly("bin", &PickPlan::bin)
    .def_readonly("seconds", &PickPlan::seconds);
  module.def("plan",
    [](const std::vector<Model>& models, const std::vector<Mesh>& parts, const std::vector<Grasps>& grasps,
      const std::vector<GripperModel>& grippers, const PlanSettings& settings, const Detections& found,
      const Scan& scan, const Workplace& place)
    {
      return withoutLock(
        [&](const Progress& progress)
        {
          std::vector<Picker> pickers;
          for (std::size_t k = 0; k < models.size(); ++k)
          {
            pickers.emplace_back(models[k], parts[k], grasps[k], grippers[k], settings);
          }
          return Picker::planAll(pickers, found, scan, place, progress);
        });
    });
}
}

void bindPicks(py::module_& module)
{
  bindGrasps(module);
  bindSettings(module);
  bindPlanning(module);
}
}
