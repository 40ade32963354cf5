// SPDX-License-Identifier: BSD-3-Clause
/// PPF-MEAM: 6D poses of the copies of a part in a scan.
///
///     meam::Model model = meam::train(meam::loadCAD("part.step"));   // once for each part; meam::train
///     model.save("part.meam");
///
///     meam::Model model = meam::loadModel("part.meam");              // in the cell; meam::detect, no GPL in it
///     for (const meam::DetectedPose& pose : meam::detect(model, meam::loadScan("scan.pcd")).poses) ...
///
/// Where a gripper takes them: picks.h.
///
/// Lengths are in mm. Every failure is a meam::Error whose message says what is wrong and what to do. The same input
/// gives the same result, for any number of threads.
#pragma once

#include "base/Error.h"                   // Error, Aborted, Progress
#include "calibration/ModelCalibration.h" // JudgedPose, CalibrationReport
#include "features/Preset.h"              // Preset, Features
#include "features/TrainSettings.h"       // TrainSettings
#include "io/cad/CADSettings.h"           // CADSettings
#include "pose/DetectSettings.h"          // DetectSettings
#include "scene/Image.h"                  // Image
#include "scene/PinholeCamera.h"          // Camera
#include "scene/ScanQuality.h"            // ScanQuality
#include "scene/Sensor.h"                 // Sensor
#include "scene/preparation/Region.h"     // Region

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#define MEAM_EXPORT __attribute__((visibility("default")))

static_assert(alignof(Eigen::Isometry3d) <= 16,
  "The library is built with Eigen's alignment of 16 bytes: leave -march=native and -mavx away, or define "
  "EIGEN_MAX_STATIC_ALIGN_BYTES=16 in the files that include meam.h");

namespace meam
{
struct TrainedModel;

/// What training makes of a part and detection needs to know of it. Copies share it; it never changes, so that many
/// threads may use it at once.
class MEAM_EXPORT Model
{
public:
  Model() = default; ///< no part
  explicit Model(std::shared_ptr<const TrainedModel> trained);

  explicit operator bool() const { return this->Trained != nullptr; }
  double diameter() const;            ///< mm, the largest distance between two points of the part
  Eigen::AlignedBox3d bounds() const; ///< mm, of the part along its axes
  Eigen::Vector3d middle() const;     ///< mm, of the part's surface

  /// Writes one file, NAME.meam by custom; whole or not at all.
  void save(const std::string& path) const;

  /// For this library's own use. Throws Error when there is no part.
  const TrainedModel& trained() const;

private:
  std::shared_ptr<const TrainedModel> Trained;
};

// ---------------------------------------------------------------------------------------------------------- detection
// Library meam::detect.

/// What a sensor saw, best in its own frame (x right, y down, z the way it looks). The edges of the parts come from an
/// image, from the cloud itself (DetectSettings), or are given as `edges`. Points alone are brought onto a grid.
struct Scan
{
  int width = 0;                       ///< of the grid of points
  int height = 1;                      ///< 1: the points are not organized
  std::vector<Eigen::Vector3f> points; ///< mm, row by row from the top left; NaN where nothing was measured

  /// Grey values or colours; a pixel for each point, or of `imageCamera`. None: edges are those of the cloud alone.
  Image image;
  std::optional<Camera> imageCamera; ///< a camera beside the sensor that took the image

  std::vector<Eigen::Vector3f> edges; ///< mm, edge points, where they are known already
  /// Where it was seen from; a perspective one without a direction, (0, 0, 0), looks at the middle of the points. None:
  /// organized points from the origin, with `edges` along +z; others from where their lattice tells, from the origin or
  /// far above along -z, or from where the fewest hide others; with `edges` from far above.
  std::optional<Sensor> sensor;

  /// Parts whose middle lies elsewhere are not looked for, and what is far from it is not looked at. None: everywhere.
  Region region;
};

/// Another rotation of a pose that hardly moves the part's surface, as about the axis of a nearly round part.
struct DetectedRotation
{
  Eigen::Isometry3d T_scan_part = Eigen::Isometry3d::Identity();
  double share = 0.0; ///< [0, 1], how likely it is where a copy is there
};

/// A copy of the part.
struct DetectedPose
{
  Eigen::Isometry3d T_scan_part = Eigen::Isometry3d::Identity(); ///< takes the part's coordinates (mm) to the scan's
  double score = 0.0;            ///< [0, 1], share of what should be visible that is there
  double placeProbability = 0.0; ///< [0, 1], that a copy is there, however it is turned by a near-symmetry
  double probability = 0.0;      ///< [0, 1], that it is also turned like this: placeProbability times certainty
  double certainty = 1.0;        ///< [0, 1], that no near-symmetry turns it: low when what breaks it is not in sight
  double visibleFraction = 0.0;  ///< [0, 1], share of the part's side towards the sensor that nothing hides
  double residual = 0.0;         ///< mm, root mean square between the part and the scan
  int votes = 0;                 ///< of the peak that it came from
  int viewId = -1;               ///< the appearance model that shows what the sensor sees of it
  /// Of a small motion about Model::middle(), axes of the scan: rotation vector (radians), then translation (mm).
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<DetectedRotation> alternatives; ///< to its rotation, the likeliest first
  int part = 0;                               ///< index of the model, where several types of part are looked for
};

struct Detections
{
  std::vector<DetectedPose> poses; ///< best first
  ScanQuality quality;             ///< how well the sensor measured, as an organized scan shows; mostly to be looked at
  double seconds = 0.0;
  bool isCutShort = false; ///< the time limit struck: these are the best that were found until then
  std::string report; ///< what was assumed of the scan, and what of it was left out; empty when there was nothing to
  std::string advice; ///< what to change first for more parts or surer ones; empty where nothing stands out
  std::string
    warning; ///< that it struck, that nothing sure was found, and what may be wrong with the scan's unit; mostly empty
};

/// Finds the copies of a part in a scan.
MEAM_EXPORT Detections detect(
  const Model& model, const Scan& scan, const DetectSettings& settings = {}, const Progress& progress = {});

/// A model and how its probabilities hold.
struct CalibratedModel
{
  Model model;
  CalibrationReport report;
};

/// Finds the copies of several types of part in a scan: of poses that claim the same surface the best supported stays.
/// Parts that look alike are told apart only when they are looked for together.
MEAM_EXPORT Detections detect(const std::vector<Model>& models, const Scan& scan, const DetectSettings& settings = {},
  const Progress& progress = {});

/// Fits what a model says of its poses to poses of one's own scans of which it is known whether they are right: of a
/// few dozen scans all that came out, or those that were looked at. A calibration takes the place of the model's one
/// before, by which the poses were told. Throws Error for fewer than 20 poses or 5 scans.
MEAM_EXPORT CalibratedModel calibrate(const Model& model, const std::vector<JudgedPose>& poses);

/// Reads what Model::save() wrote.
MEAM_EXPORT Model loadModel(const std::string& path);

/// Reads a scan: a .pcd, a .ply, the vertices of an .obj, or a text with a point in each line (.xyz, .csv, .txt, .asc,
/// .pts); one that is not organized comes back onto its camera's pixels when that is given. Colours or grey values
/// become the image, and a VIEWPOINT that points alone were seen from the sensor. `scale` brings lengths to mm: 1000
/// for metres.
MEAM_EXPORT Scan loadScan(const std::string& path, const std::string& cameraFile = {}, double scale = 1.0);

/// A scan of what a depth camera gave: distances along its z axis, one for each pixel, row by row from the top; NaN, 0
/// and less are not measured. `scale` brings them to mm. The camera's pose does not matter, nor its size where it is 0.
/// Throws Error for another number of depths, a camera of another size, and where nothing is nearer than 50 m.
MEAM_EXPORT Scan scanOfDepths(
  const std::vector<float>& depths, int width, int height, const Camera& camera, double scale = 1.0);

/// A part's surface. Corners of a triangle go counter-clockwise seen from outside.
struct Mesh
{
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;
  std::string report{}; ///< what was assumed of its file; mostly empty
};

/// Reads a mesh: .stl, .obj, .ply or .off, in the file's own unit. loadCAD() reads STEP and IGES, too.
MEAM_EXPORT Mesh loadMesh(const std::string& path);

/// Reads a calibration of OpenCV (YAML, XML, JSON) or BOP (camera.json), for Scan::imageCamera.
MEAM_EXPORT Camera loadCamera(const std::string& path);
/// The same of a sensor's own camera, for scanOfDepths(): where it is does not matter.
MEAM_EXPORT Camera loadDepthCamera(const std::string& path);
/// mm for a value of 1 of the camera's depth images, as its calibration says; 1 where it does not.
MEAM_EXPORT double loadDepthScale(const std::string& path);

// ------------------------------------------------------------------------------------------------------------- images
// Library meam::images, for those who have images as files. It links OpenCV's imgcodecs, which in Debian links GDAL and
// with it Poppler, which is under the GPL.

/// Reads a PNG, JPEG, BMP or TIFF image, for Scan::image.
MEAM_EXPORT Image loadImage(const std::string& path);

/// Reads a depth image of 16 bits, PNG, TIFF or PGM, or of real numbers, TIFF or PFM, with the calibration of its
/// camera, whose `depth_scale` brings it to mm; `scale` is a factor beside it.
MEAM_EXPORT Scan loadDepthImage(const std::string& path, const std::string& cameraFile, double scale = 1.0);

// ----------------------------------------------------------------------------------------------------------- training
// Library meam::train. It holds parts of CGAL that are under the GPL; what is linked with it is, too.

/// Reads a part: .step, .stp, .iges or .igs, in mm, or a mesh as loadMesh() does. All solids of a file are one part,
/// unless the settings choose one; which way the faces of an IGES file look is what prepareMesh() and train() find out.
MEAM_EXPORT Mesh loadCAD(const std::string& path, const CADSettings& settings = {}, const Progress& progress = {});

/// The mesh as training takes it: in mm, mended, and facing outwards.
MEAM_EXPORT Mesh prepareMesh(
  const Mesh& mesh, double scale = 1.0, const Eigen::Vector3d& offset = Eigen::Vector3d::Zero());

/// Learns how a part looks from all sides; what is wrong with its mesh is mended. Takes seconds, on all processors.
MEAM_EXPORT Model train(const Mesh& mesh, const TrainSettings& settings = {}, const Progress& progress = {});
}
