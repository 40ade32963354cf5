// SPDX-License-Identifier: BSD-3-Clause
#include "Conversion.h"

#include <algorithm>
#include <array>
#include <limits>

namespace meamPython
{
namespace
{
using namespace meam;
using Unlocked = py::call_guard<py::gil_scoped_release>;
using Pixels = py::array_t<std::uint8_t, py::array::c_style>;

/// H x W x 3 points are a grid, N x 3 are not organized.
Scan scanOf(const Triples<float>& points)
{
  const bool organized = points.ndim() == 3;
  Scan scan;
  scan.width = static_cast<int>(points.shape(organized ? 1 : 0));
  scan.height = organized ? static_cast<int>(points.shape(0)) : 1;
  scan.points = vectorsOf(points);
  return scan;
}

py::array_t<float> pointsOf(const Scan& scan)
{
  py::array_t<float> points = arrayOf(scan.points);
  return scan.height > 1 ? points.reshape({ scan.height, scan.width, 3 }) : points;
}

/// Points with a flag that is not 0 are not measured.
void blank(Scan& scan, const Pixels& flags)
{
  for (std::size_t i = 0; i < scan.points.size(); ++i)
  {
    if (flags.data()[i] != 0)
    {
      scan.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
    }
  }
}

/// H x W, or H x W x 1 or 3.
Image imageOf(const Pixels& pixels)
{
  Image image;
  image.height = static_cast<int>(pixels.shape(0));
  image.width = static_cast<int>(pixels.shape(1));
  image.channels = pixels.ndim() == 3 ? static_cast<int>(pixels.shape(2)) : 1;
  image.pixels.assign(pixels.data(), pixels.data() + pixels.size());
  return image;
}

/// None when there is no image.
py::object pixelsOf(const Image& image)
{
  if (image.pixels.empty())
  {
    return py::none();
  }
  std::vector<py::ssize_t> shape{ image.height, image.width };
  if (image.channels > 1)
  {
    shape.push_back(image.channels);
  }
  return Pixels(shape, image.pixels.data());
}

Camera cameraOf(int width, int height, const Eigen::Matrix3d& matrix, const Eigen::Matrix4d& T_camera_scan)
{
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = matrix(0, 0);
  camera.fy = matrix(1, 1);
  camera.cx = matrix(0, 2);
  camera.cy = matrix(1, 2);
  camera.T_camera_scene.matrix() = T_camera_scan;
  return camera;
}

Eigen::Matrix3d matrixOf(const Camera& camera)
{
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 0) = camera.fx;
  matrix(1, 1) = camera.fy;
  matrix(0, 2) = camera.cx;
  matrix(1, 2) = camera.cy;
  return matrix;
}

/// Empty when it is not known.
py::dict numbersOf(const ScanQuality& quality)
{
  using namespace py::literals;
  return !quality.isKnown()
           ? py::dict()
           : py::dict("PointDistance"_a = quality.pointDistance, "Noise"_a = quality.noise,
               "Smoothing"_a = quality.smoothing, "DepthStep"_a = quality.depthStep, "JumpGap"_a = quality.jumpGap,
               "Flying"_a = quality.flying, "Coverage"_a = quality.coverage);
}

/// Poses N x 4 x 4 of which no more is known.
Detections detectionsOf(const py::array_t<double, py::array::c_style | py::array::forcecast>& transforms)
{
  Detections found;
  found.poses.resize(static_cast<std::size_t>(transforms.shape(0)));
  for (std::size_t k = 0; k < found.poses.size(); ++k)
  {
    found.poses[k].T_scan_part.matrix() =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(transforms.data() + 16 * k);
  }
  return found;
}

void bindData(py::module_& module)
{
  py::class_<Mesh>(module, "Mesh")
    .def(py::init(
      [](const Triples<float>& vertices, const Triples<int>& triangles) {
        return Mesh{ vectorsOf(vertices), vectorsOf(triangles) };
      }))
    .def_property_readonly("vertices", [](const Mesh& mesh) { return arrayOf(mesh.vertices); })
    .def_property_readonly("triangles", [](const Mesh& mesh) { return arrayOf(mesh.triangles); })
    .def_readonly("report", &Mesh::report);
  py::class_<Camera>(module, "Camera")
    .def(py::init(&cameraOf))
    .def_property_readonly("matrix", &matrixOf)
    .def_property_readonly("pose", [](const Camera& camera) { return camera.T_camera_scene.matrix(); })
    .def_readonly("distortion", &Camera::distortion);
  py::class_<Sensor>(module, "Sensor") // that looks at the middle of the points
    .def(py::init(
      [] {
        return Sensor{ true, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
      }))
    .def_readwrite("position", &Sensor::position);
  py::class_<Scan>(module, "Scan")
    .def(py::init(&scanOf))
    .def("blank", &blank)
    .def_property_readonly("points", &pointsOf)
    .def_property(
      "image", [](const Scan& scan) { return pixelsOf(scan.image); },
      [](Scan& scan, const Pixels& pixels) { scan.image = imageOf(pixels); })
    .def_property(
      "edges", [](const Scan& scan) { return arrayOf(scan.edges); },
      [](Scan& scan, const Triples<float>& edges) { scan.edges = vectorsOf(edges); })
    .def_readwrite("image_camera", &Scan::imageCamera)
    .def_readwrite("sensor", &Scan::sensor)
    .def_property("region_box", nullptr,
      [](Scan& scan, const std::array<double, 6>& ends) {
        scan.region.box = { Eigen::Vector3d(ends[0], ends[2], ends[4]), Eigen::Vector3d(ends[1], ends[3], ends[5]) };
      })
    .def_property(
      "region_mask",
      [](const Scan& scan)
      { return Pixels(static_cast<py::ssize_t>(scan.region.mask.size()), scan.region.mask.data()); },
      [](Scan& scan, const Pixels& mask) { scan.region.mask.assign(mask.data(), mask.data() + mask.size()); });
  module.def(
    "load_cad",
    [](const std::string& path, const CADSettings& settings)
    { return withoutLock([&](const Progress& progress) { return loadCAD(path, settings, progress); }); },
    py::arg("path"), py::arg("settings") = CADSettings());
  module.def("load_scan", &loadScan, Unlocked());
  module.def("load_depth_image", &loadDepthImage, Unlocked());
  module.def("load_image", [](const std::string& path) { return pixelsOf(loadImage(path)); });
  module.def("load_camera", &loadCamera, Unlocked());
  module.def("load_depth_camera", &loadDepthCamera, Unlocked());
  module.def("load_depth_scale", &loadDepthScale, Unlocked());
  module.def("scan_of_depths",
    [](const py::array_t<float, py::array::c_style>& depths, const Camera& camera, double scale)
    {
      const std::vector<float> values(depths.data(), depths.data() + depths.size());
      return scanOfDepths(values, static_cast<int>(depths.shape(1)), static_cast<int>(depths.shape(0)), camera, scale);
    });
}

void bindSettings(py::module_& module)
{
  py::enum_<Preset> presets(module, "Preset");
  for (int preset = 0; preset < Presets; ++preset)
  {
    presets.value(nameOf(static_cast<Preset>(preset)), static_cast<Preset>(preset));
  }
  py::enum_<Features> features(module, "Features");
  for (const Features each : { Features::Edges, Features::Surface, Features::Both })
  {
    features.value(nameOf(each), each);
  }
  py::class_<DetectSettings>(module, "DetectSettings")
    .def(py::init<>())
    .def_readwrite("preset", &DetectSettings::preset)
    .def_readwrite("features", &DetectSettings::features)
    .def_readwrite("maximumPoses", &DetectSettings::maximumPoses)
    .def_readwrite("minimumProbability", &DetectSettings::minimumProbability)
    .def_readwrite("rotationCounts", &DetectSettings::rotationCounts)
    .def_readwrite("referenceShare", &DetectSettings::referenceShare)
    .def_readwrite("timeLimit", &DetectSettings::timeLimit)
    .def_readwrite("imageEdges", &DetectSettings::imageEdges)
    .def_readwrite("depthEdges", &DetectSettings::depthEdges)
    .def_readwrite("creases", &DetectSettings::creases)
    .def_readwrite("seed", &DetectSettings::seed)
    .def_readwrite("threads", &DetectSettings::threads);
  py::class_<CADSettings>(module, "CADSettings").def(py::init<>()).def_readwrite("solid", &CADSettings::solid);
  py::class_<TrainSettings>(module, "TrainSettings")
    .def(py::init<>())
    .def_readwrite("preset", &TrainSettings::preset)
    .def_readwrite("features", &TrainSettings::features)
    .def_readwrite("scale", &TrainSettings::scale)
    .def_readwrite("offset", &TrainSettings::offset)
    .def_readwrite("seed", &TrainSettings::seed);
}

void bindCalibration(py::module_& module)
{
  py::class_<JudgedPose>(module, "JudgedPose")
    .def(py::init(
      [](double place, double certainty, bool isThere, bool isTurnedRight, int scene) {
        return JudgedPose{ place, certainty, isThere, isTurnedRight, scene };
      }));
  py::class_<ClaimClass>(module, "ClaimClass")
    .def_readonly("with_rotation", &ClaimClass::withRotation)
    .def_readonly("least", &ClaimClass::least)
    .def_readonly("most", &ClaimClass::most)
    .def_readonly("poses", &ClaimClass::poses)
    .def_readonly("right", &ClaimClass::right)
    .def_readonly("before", &ClaimClass::before)
    .def_readonly("after", &ClaimClass::after);
  py::class_<CalibrationReport>(module, "CalibrationReport")
    .def_readonly("loss_before", &CalibrationReport::lossBefore)
    .def_readonly("loss_after", &CalibrationReport::lossAfter)
    .def_readonly("classes", &CalibrationReport::classes)
    .def_readonly("warning", &CalibrationReport::warning);
  module.def("calibrate",
    [](const Model& model, const std::vector<JudgedPose>& poses)
    {
      const CalibratedModel calibrated = calibrate(model, poses);
      return std::make_pair(calibrated.model, calibrated.report);
    });
}
}

void bindDetection(py::module_& module)
{
  bindSettings(module);
  bindData(module);
  py::class_<Model>(module, "Model")
    .def(py::init<>())
    .def_property_readonly("diameter", &Model::diameter)
    .def_property_readonly("middle", &Model::middle)
    .def_property_readonly("bounds",
      [](const Model& model) { return std::make_pair(model.bounds().min().eval(), model.bounds().max().eval()); })
    .def("save", &Model::save, Unlocked());
  module.def("load_model", &loadModel, Unlocked());
  module.def("train", [](const Mesh& mesh, const TrainSettings& settings)
    { return withoutLock([&](const Progress& progress) { return train(mesh, settings, progress); }); });

  py::class_<DetectedPose>(module, "Pose", "A copy of the part.")
    .def_property_readonly(
      "transform", [](const DetectedPose& pose) { return pose.T_scan_part.matrix(); },
      "4 x 4, takes the part's coordinates (mm) to the scan's.")
    .def_property_readonly(
      "quaternion",
      [](const DetectedPose& pose)
      {
        const Eigen::Quaterniond rotation = Eigen::Quaterniond(pose.T_scan_part.linear()).normalized();
        return Eigen::Vector4d(rotation.coeffs() * (rotation.w() < 0.0 ? -1.0 : 1.0));
      },
      "Its rotation: x y z w, w not negative.")
    .def_readonly("score", &DetectedPose::score, "[0, 1], share of what should be visible that is there.")
    .def_readonly("place_probability", &DetectedPose::placeProbability,
      "[0, 1], that a copy is there, however it is turned by a near-symmetry of the part.")
    .def_readonly("probability", &DetectedPose::probability,
      "[0, 1], that it is also turned like this: place_probability times certainty.")
    .def_readonly("certainty", &DetectedPose::certainty,
      "[0, 1], that no near-symmetry turns it: low when what breaks it is not visible.")
    .def_readonly("visible_fraction", &DetectedPose::visibleFraction,
      "[0, 1], share of the part's side towards the sensor that nothing hides.")
    .def_readonly("residual", &DetectedPose::residual, "mm, root mean square between the part and the scan.")
    .def_readonly("part", &DetectedPose::part, "Index of the model, where several types of part are looked for.")
    .def_readonly("votes", &DetectedPose::votes, "Of the peak that it came from.")
    .def_readonly("view_id", &DetectedPose::viewId, "The appearance model that shows what the sensor sees of it.")
    .def_readonly("covariance", &DetectedPose::covariance,
      "6 x 6, of a small motion about the middle of the part's surface, axes of the scan: rotation vector (radians), "
      "then translation (mm).")
    .def_property_readonly(
      "alternatives",
      [](const DetectedPose& pose)
      {
        std::vector<std::pair<Eigen::Matrix4d, double>> rotations;
        for (const DetectedRotation& other : pose.alternatives)
        {
          rotations.emplace_back(other.T_scan_part.matrix(), other.share);
        }
        return rotations;
      },
      "Other rotations that hardly move the part's surface, the likeliest first: (transform, share), of which the "
      "share "
      "is how likely it is where a copy is there.");
  py::class_<Detections>(module, "Detections")
    .def(py::init(&detectionsOf))
    .def_readonly("poses", &Detections::poses)
    .def_readonly("advice", &Detections::advice)
    .def("of",
      [](const Detections& found, int part)
      {
        Detections of = found;
        of.poses.erase(std::remove_if(of.poses.begin(), of.poses.end(),
                         [part](const DetectedPose& pose) { return pose.part != part; }),
          of.poses.end());
        return of;
      })
    .def_property_readonly("quality", [](const Detections& found) { return numbersOf(found.quality); })
    .def_readonly("seconds", &Detections::seconds)
    .def_readonly("is_cut_short", &Detections::isCutShort)
    .def_readonly("report", &Detections::report)
    .def_readonly("warning", &Detections::warning);
  bindCalibration(module);
  module.def("detect", [](const std::vector<Model>& models, const Scan& scan, const DetectSettings& settings)
    { return withoutLock([&](const Progress& progress) { return detect(models, scan, settings, progress); }); });
}
}
