// SPDX-License-Identifier: BSD-3-Clause
#include "io/CameraFile.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/StorageText.h"
#include "io/parsing/TextLines.h"
#include "scene/Units.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <iterator>
#include <optional>

namespace meam
{
namespace
{
// A calibration is a page of text; more is another kind of file.
constexpr std::size_t MostBytes = 1 << 20;
constexpr double MostPixels = 65535.0;    // in a row or a column
constexpr double LeastFocalLength = 0.05; // of the image's width: a pinhole camera of 170 degrees
constexpr double LeastFocalPixels = 20.0; // lenses have as many mm; of a small image half its width
constexpr double NearestCamera = 1.0;     // mm, beside the scan's; in metres cameras are 0.01 to 1 apart
constexpr double LeastOffset = 0.005;     // mm, what calibration leaves of one at the same place

[[noreturn]] void failCamera(const std::string& path, const std::string& what)
{
  throw Error("The camera file '" + path + "' " + what + ".");
}

/// A name in lower case, its letters and digits alone: programs differ in the rest.
std::string bareName(const std::string& name)
{
  std::string bare;
  for (const char letter : name)
  {
    if (std::isalnum(static_cast<unsigned char>(letter)))
    {
      bare += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
  }
  return bare;
}

using Names = std::initializer_list<const char*>;

/// The name in the file of the entry that has the first of the names; empty without.
std::string keyOf(const nlohmann::json& entries, Names names)
{
  for (const char* name : names)
  {
    const std::string bare = bareName(name);
    for (const auto& [key, value] : entries.items()) // of a list the keys are numbers
    {
      if (bareName(key) == bare)
      {
        return key;
      }
    }
  }
  return {};
}

/// Numbers by any of the names, empty without; fails when there are not as many as there should be.
std::vector<double> find(
  const std::string& path, const nlohmann::json& entries, Names names, std::size_t fewest, std::size_t most)
{
  const std::string key = keyOf(entries, names);
  if (key.empty())
  {
    return {};
  }
  const std::vector<double> numbers = numbersOfMatrix(entries[key], path, key);
  if (numbers.size() < fewest || numbers.size() > most)
  {
    failCamera(
      path, "has " + std::to_string(numbers.size()) + " numbers as " + key + " instead of " + std::to_string(fewest));
  }
  return numbers;
}

int pixels(const std::string& path, const std::vector<double>& numbers)
{
  const double value = numbers.empty() ? 0.0 : numbers.front();
  if (!(value >= 0.0 && value <= MostPixels) || value != std::floor(value))
  {
    failCamera(path, "has an impossible width or height of the image");
  }
  return static_cast<int>(value);
}

/// Whether an entry has other numbers than those of the identity, 0 and 1.
bool isMoved(const nlohmann::json& value)
{
  if (value.is_object() && value.contains("data"))
  {
    return isMoved(value["data"]);
  }
  return value.is_structured() ? std::any_of(value.begin(), value.end(), isMoved)
                               : value.is_number() && value != 0.0 && value != 1.0;
}

/// Of a place whose frames or units the file does not tell.
std::string doubtOfPlace(const nlohmann::json& entries)
{
  const std::string rotation = keyOf(entries, { "rotation", "orientation", "quaternion" });
  for (const char* name :
    { "extrinsic", "extrinsics", "extrinsic_matrix", "camera_extrinsics", "transform", rotation.c_str() })
  {
    const std::string key = *name == 0 ? std::string() : keyOf(entries, { name });
    if (!key.empty() && isMoved(entries[key]))
    {
      return "tells the camera's place as " + key +
             ", but neither from which frame nor in which unit: give T_camera_scene, 4x4, mm, which takes the scan's "
             "points to the camera's";
    }
  }
  return {};
}

/// Of a place whose translation is likely in metres. `distance`: mm.
std::string doubtOfUnit(double distance)
{
  if (distance <= LeastOffset || distance >= NearestCamera)
  {
    return {};
  }
  char told[32];
  std::snprintf(told, sizeof told, "%.3g", distance);
  return std::string("puts the camera ") + told +
         " mm from the scan's: its translation is likely in metres, give it in mm";
}

/// Where the camera is, from `T_camera_scene`, `R` and `T`, `rvec` and `tvec`, or Kalibr's `T_cn_cnm1`; the identity
/// without.
Eigen::Isometry3d placeOf(const std::string& path, const nlohmann::json& entries)
{
  const std::vector<double> whole = find(path, entries, { "T_camera_scene" }, 16, 16);
  const std::vector<double> ofKalibr = find(path, entries, { "T_cn_cnm1" }, 16, 16);
  const std::vector<double> turn = find(path, entries, { "rvec" }, 3, 3), shift = find(path, entries, { "tvec" }, 3, 3);
  // ROS has an R of its own, which rectifies the image.
  const bool isOfROS = entries.is_object() && (entries.contains("K") || entries.contains("distortion_model"));
  const bool isRectification = isOfROS && !entries.contains("T");
  const std::vector<double> rotation = isRectification ? std::vector<double>() : find(path, entries, { "R" }, 9, 9);
  const std::vector<double> translation = find(path, entries, { "T" }, 3, 3);
  Eigen::Isometry3d T_camera_scene = Eigen::Isometry3d::Identity();
  if (!whole.empty())
  {
    T_camera_scene = transformOf(whole.data());
  }
  else if (!rotation.empty() && !translation.empty())
  {
    T_camera_scene.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data());
    T_camera_scene.translation() = Eigen::Map<const Eigen::Vector3d>(translation.data());
  }
  else if (!turn.empty() && !shift.empty())
  {
    const Eigen::Vector3d axis = Eigen::Map<const Eigen::Vector3d>(turn.data());
    T_camera_scene.linear() = Eigen::AngleAxisd(axis.norm(), axis.stableNormalized()).toRotationMatrix();
    T_camera_scene.translation() = Eigen::Map<const Eigen::Vector3d>(shift.data());
  }
  else if (!rotation.empty() || !translation.empty() || !turn.empty() || !shift.empty())
  {
    failCamera(path, "has only one of R and T, or of rvec and tvec: the camera's place needs both, or T_camera_scene");
  }
  else if (!ofKalibr.empty()) // from the camera before it, in metres
  {
    T_camera_scene = transformOf(ofKalibr.data());
    T_camera_scene.translation() *= Metre;
  }
  const std::optional<Eigen::Isometry3d> rigid = rigidOf(T_camera_scene.matrix());
  if (!rigid)
  {
    failCamera(path, "has a place of the camera that is not a rotation and a translation");
  }
  return *rigid;
}

/// Focal lengths and principal point.
struct Intrinsics
{
  double fx, fy, cx, cy;
};

constexpr Names MatrixNames = { "camera_matrix", "K", "cam_K", "mtx", "M1", "intrinsic_matrix", "intrinsics",
  "intrinsic", "camera_intrinsics" };
constexpr Names WidthNames = { "image_width", "width", "resolution_width" };
constexpr Names HeightNames = { "image_height", "height", "resolution_height" };
constexpr Names SizeNames = { "resolution", "camera_resolution", "image_size", "img_size" };

/// Of fx 0 cx, 0 fy cy, 0 0 1, row by row or, as Open3D has it, column by column, with a fourth column and row that say
/// nothing or without; or of fx fy cx cy, as Kalibr has them.
Intrinsics intrinsicsOfMatrix(const std::string& path, const std::string& key, const std::vector<double>& numbers)
{
  if (numbers.size() == 4 && bareName(key).find("intrinsic") != std::string::npos)
  {
    return { numbers[0], numbers[1], numbers[2], numbers[3] };
  }
  const Eigen::Index columns = numbers.size() == 9 ? 3 : 4, rows = static_cast<Eigen::Index>(numbers.size()) / columns;
  if (static_cast<std::size_t>(rows * columns) != numbers.size() || rows < 3 || rows > columns)
  {
    failCamera(path, "has " + std::to_string(numbers.size()) + " numbers as " + key + " instead of 9");
  }
  Eigen::Matrix4d whole = Eigen::Matrix4d::Identity();
  whole.topLeftCorner(rows, columns) =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      numbers.data(), rows, columns);
  if (whole.col(3) != Eigen::Vector4d::UnitW() || whole.row(3) != Eigen::RowVector4d::UnitW())
  {
    failCamera(path, "has more than a camera matrix as " + key + ": give its 9 numbers alone");
  }
  Eigen::Matrix3d K = whole.topLeftCorner<3, 3>();
  if (K(0, 2) == 0.0 && K(1, 2) == 0.0)
  {
    K.transposeInPlace();
  }
  if (K(0, 1) != 0.0 || K(1, 0) != 0.0 || K(2, 0) != 0.0 || K(2, 1) != 0.0 || K(2, 2) != 1.0)
  {
    failCamera(path, "has a camera matrix that is not fx 0 cx, 0 fy cy, 0 0 1");
  }
  return { K(0, 0), K(1, 1), K(0, 2), K(1, 2) };
}

std::optional<Intrinsics> intrinsicsOf(const std::string& path, const nlohmann::json& entries)
{
  if (!find(path, entries, { "M2" }, 0, 9).empty())
  {
    failCamera(path, "has 2 cameras, M1 and M2: leave the one that is meant");
  }
  if (const std::string key = keyOf(entries, MatrixNames); !key.empty())
  {
    return intrinsicsOfMatrix(path, key, numbersOfMatrix(entries[key], path, key));
  }
  Intrinsics result{};
  const struct
  {
    double* value;
    const char *name, *other, *ofBoth; // ppx: RealSense's
    bool isLast;
  } values[] = { { &result.fx, "fx", "fx", "focal_length", false }, { &result.fy, "fy", "fy", "focal_length", true },
    { &result.cx, "cx", "ppx", "principal_point", false }, { &result.cy, "cy", "ppy", "principal_point", true } };
  for (const auto& [value, name, other, ofBoth, isLast] : values)
  {
    auto number = find(path, entries, { name, other }, 1, 1);
    number = number.empty() ? find(path, entries, { ofBoth }, 1, 2) : number;
    if (number.empty())
    {
      return std::nullopt;
    }
    *value = isLast ? number.back() : number.front();
  }
  return result;
}

bool hasSize(const nlohmann::json& entries)
{
  return !keyOf(entries, WidthNames).empty() || !keyOf(entries, HeightNames).empty() ||
         !keyOf(entries, SizeNames).empty();
}

/// Width and height, 0 where they are not known.
std::array<int, 2> sizeOf(const std::string& path, const nlohmann::json& entries)
{
  const std::string both = keyOf(entries, SizeNames);
  const bool isNested = !both.empty() && entries[both].is_object() && !entries[both].contains("data");
  if (both.empty() || isNested || !keyOf(entries, WidthNames).empty())
  {
    const nlohmann::json& owner = isNested ? entries[both] : entries;
    if (isNested && (keyOf(owner, WidthNames).empty() || keyOf(owner, HeightNames).empty()))
    {
      failCamera(path, "has a " + both + " without a width and a height");
    }
    return { pixels(path, find(path, owner, WidthNames, 1, 1)), pixels(path, find(path, owner, HeightNames, 1, 1)) };
  }
  const auto numbers = find(path, entries, { both.c_str() }, 2, 2);
  return { pixels(path, { numbers[0] }), pixels(path, { numbers[1] }) };
}

/// Whether a bare name is one of the lens's distortion, its model's among them.
bool namesDistortion(const std::string& bare)
{
  constexpr const char* names[] = { "d", "d1", "coeff", "coeffs", "k1" };
  constexpr const char* others[] = { "distance", "distribution", "distro", "undist" };
  return std::find(std::begin(names), std::end(names), bare) != std::end(names) ||
         (bare.find("dist") != std::string::npos &&
           std::none_of(std::begin(others), std::end(others),
             [&](const char* other) { return bare.find(other) != std::string::npos; }));
}

bool namesLensModel(const std::string& bare)
{
  const auto endsWith = [&](const std::string& end)
  { return bare.size() >= end.size() && bare.compare(bare.size() - end.size(), end.size(), end) == 0; };
  return bare == "model" || (namesDistortion(bare) && (endsWith("model") || endsWith("type")));
}

/// The bare name that a file gives its lens model; empty without.
std::string lensModelOf(const nlohmann::json& entries)
{
  constexpr const char* numbered[] = { "none", "modifiedbrownconrady", "inversebrownconrady", "ftheta", "brownconrady",
    "kannalabrandt" };                             // RealSense's
  for (const auto& [key, value] : entries.items()) // distortion_model before model
  {
    const double number = namesLensModel(bareName(key)) && value.is_number() ? value.get<double>() : -1.0;
    if (number >= 0.0 && number < static_cast<double>(std::size(numbered)))
    {
      return numbered[static_cast<int>(number)];
    }
    if (namesLensModel(bareName(key)) && value.is_string())
    {
      return bareName(value.get<std::string>());
    }
  }
  return {};
}

[[noreturn]] void failLens(const std::string& path, const std::string& model)
{
  failCamera(path, "has a lens of the model '" + model +
                     "', which is not read: calibrate it as plumb_bob or rational_polynomial, or undistort the "
                     "images and leave the coefficients away");
}

/// Fails for a camera that is no pinhole, whatever its coefficients are.
void requirePinhole(const std::string& path, const nlohmann::json& entries)
{
  const auto has = [&](const char* name)
  {
    const auto number = find(path, entries, { name }, 1, 1);
    return !number.empty() && number.front() != 0.0;
  };
  if (has("xi") || has("beta"))
  {
    failLens(path, has("xi") ? "omni" : "eucm");
  }
  if (has("skew"))
  {
    failCamera(path, "has a skew, which is not read: calibrate with columns at right angles to rows");
  }
  if (const auto fisheye = find(path, entries, { "fisheye_model" }, 1, 1); !fisheye.empty() && fisheye.front() != 0.0)
  {
    failLens(path, "fisheye"); // OpenCV's
  }
  for (const auto& [key, value] : entries.items())
  {
    const bool isNamed = bareName(key) == "cameramodel" && value.is_string();
    const std::string model = isNamed ? bareName(value.get<std::string>()) : std::string();
    if (model == "omni" || model == "ds" || model == "eucm" || model.find("fisheye") != std::string::npos)
    {
      failLens(path, model); // Kalibr's
    }
  }
}

/// Of entries that are named k1, k2 and so on, in OpenCV's order.
std::vector<double> namedCoefficients(const std::string& path, const nlohmann::json& entries)
{
  std::vector<double> numbers;
  std::vector<bool> isGiven;
  for (const char* name : { "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y" })
  {
    const auto number = find(path, entries, { name }, 1, 1);
    isGiven.push_back(!number.empty());
    numbers.push_back(number.empty() ? 0.0 : number.front());
  }
  // Other models have a k1 without p1 and p2, as fisheye's, or a k4 without k5 and k6.
  const bool isPlain = isGiven[0] && isGiven[1] && isGiven[2] && isGiven[3];
  const bool isRational = isGiven[5] && isGiven[6] && isGiven[7];
  if ((!isPlain || (!isRational && (isGiven[5] || isGiven[6] || isGiven[7]))) &&
      std::any_of(numbers.begin(), numbers.end(), [](double number) { return number != 0.0; }))
  {
    failCamera(path, "names coefficients of its lens that are neither k1 k2 p1 p2, k1 k2 p1 p2 k3 nor k1 k2 p1 p2 k3 "
                     "k4 k5 k6: calibrate with these");
  }
  return numbers;
}

/// k1 k2 p1 p2 k3 k4 k5 k6 of a lens of that model, from the numbers that a file has.
std::array<double, 8> coefficientsOf(
  const std::string& path, const std::string& model, const std::vector<double>& numbers)
{
  std::array<double, 8> result{};
  if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0.0; }))
  {
    return result; // of any model
  }
  // By their number of coefficients, where they are named; a name that is not known may be of any lens.
  const bool isBrown = model.empty() || model == "plumbbob" || model == "radtan" || model == "browndistortion" ||
                       model.rfind("browncon", 0) == 0 || model == "distortionbrownconrady" || model == "pinhole";
  const bool isRational = model == "rationalpolynomial" || model == "rational";
  if (!isBrown && !isRational)
  {
    failLens(path, model);
  }
  if (numbers.size() < 4 || (isRational && numbers.size() < 8))
  {
    failCamera(path, "has " + std::to_string(numbers.size()) + " numbers of its lens's distortion instead of " +
                       (isRational ? "8: k1 k2 p1 p2 k3 k4 k5 k6" : "4 or 5: k1 k2 p1 p2 k3"));
  }
  constexpr std::size_t most = 5; // of a lens that is named as Brown's
  if (isBrown && !model.empty() && model != "pinhole" &&
      std::any_of(numbers.begin() + static_cast<std::ptrdiff_t>(std::min(most, numbers.size())), numbers.end(),
        [](double number) { return number != 0.0; }))
  {
    failCamera(path, "has " + std::to_string(numbers.size()) + " numbers of its lens's distortion, and its model, " +
                       model + ", takes 4 or 5: name it rational_polynomial if k4 k5 k6 are meant");
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (i < result.size())
    {
      result[i] = numbers[i];
    }
    else if (numbers[i] != 0.0)
    {
      failCamera(path, "has a lens with a thin prism or a tilted sensor: calibrate with k1 k2 p1 p2 k3 k4 k5 k6 alone");
    }
  }
  return result;
}

/// Of every entry that is named like a distortion: one that is not read is refused.
std::array<double, 8> distortionOf(const std::string& path, const nlohmann::json& entries)
{
  std::array<double, 8> result{};
  std::string found;
  for (const auto& [key, value] : entries.items())
  {
    const std::string name = bareName(key);
    if (!namesDistortion(name) || namesLensModel(name) || value.is_null())
    {
      continue;
    }
    const nlohmann::json& owner = name == "k1" ? entries : value;
    const bool isNamed = owner.is_object() && (name == "k1" || !find(path, owner, { "k1" }, 1, 1).empty());
    const std::string model = isNamed ? lensModelOf(owner) : std::string();
    const std::array<double, 8> coefficients = coefficientsOf(path, model.empty() ? lensModelOf(entries) : model,
      isNamed ? namedCoefficients(path, owner) : numbersOfMatrix(value, path, key));
    if (!found.empty() && coefficients != result)
    {
      failCamera(path, "has a lens with other coefficients as " + key + " than as " + found + ": leave the right ones");
    }
    result = coefficients;
    found = key;
  }
  return result;
}

/// A camera's numbers are those of its whole sensor, also where ROS makes its image smaller.
void requireWholeImage(const std::string& path, const nlohmann::json& entries)
{
  const auto isMore = [&](const nlohmann::json& in, const char* name, double most)
  {
    const auto number = find(path, in, { name }, 1, 1);
    return !number.empty() && number.front() > most;
  };
  bool isPart = isMore(entries, "binning_x", 1.0) || isMore(entries, "binning_y", 1.0);
  if (entries.is_object() && entries.contains("roi"))
  {
    isPart = isPart || isMore(entries["roi"], "x_offset", 0.0) || isMore(entries["roi"], "y_offset", 0.0);
  }
  if (isPart)
  {
    failCamera(path, "has a binning or a region of interest (binning_x, binning_y, roi), which is not read: give the "
                     "calibration of the image as it is, and set these to 0");
  }
}

/// Whether an object has the intrinsics of a camera themselves, not in objects within.
bool isOfCamera(const nlohmann::json& entries)
{
  if (!entries.is_object())
  {
    return false;
  }
  const std::string matrix = keyOf(entries, MatrixNames);
  const nlohmann::json& value = matrix.empty() ? entries : entries[matrix];
  const bool hasObjects = value.is_array() && !value.empty() && value.front().is_object(); // a list of cameras
  const bool isMatrix =
    !matrix.empty() && !hasObjects && (!value.is_object() || value.contains("data") || value.contains("rows"));
  const bool isPair =
    !keyOf(entries, { "focal_length" }).empty() && !keyOf(entries, { "principal_point", "cx", "ppx" }).empty();
  return isMatrix || isPair || !keyOf(entries, { "fx" }).empty();
}

using Ancestors = std::vector<const nlohmann::json*>;

/// Each camera with what it stands in, the file first.
void findCameras(const nlohmann::json& in, Ancestors& above, std::vector<Ancestors>& cameras)
{
  if (!in.is_structured())
  {
    return;
  }
  above.push_back(&in);
  if (isOfCamera(in))
  {
    cameras.push_back(above);
  }
  else
  {
    for (const nlohmann::json& entry : in)
    {
      findCameras(entry, above, cameras);
    }
  }
  above.pop_back();
}

/// The one camera's entries, which many programs have a level deeper, and those beside them.
nlohmann::json entriesOfCamera(const std::string& path, const nlohmann::json& file)
{
  Ancestors above;
  std::vector<Ancestors> cameras;
  findCameras(file, above, cameras);
  if (cameras.size() > 1)
  {
    failCamera(path, "has " + std::to_string(cameras.size()) + " cameras: leave the one that is meant");
  }
  if (cameras.empty())
  {
    return nlohmann::json::object();
  }
  const Ancestors& found = cameras.front();
  nlohmann::json entries = *found.back();
  for (std::size_t i = found.size() - 1; i > 0; --i)
  {
    const bool isSized = hasSize(entries);
    for (const auto& [name, entry] : found[i - 1]->items()) // of a list the names are numbers
    {
      const bool isOther = bareName(name) == "model" || (isSized && hasSize({ { name, entry } })); // the device's
      if (&entry != found[i] && !isOther && keyOf(entries, { name.c_str() }).empty())
      {
        entries[name] = entry;
      }
    }
  }
  return entries;
}

/// A text that is the numbers of a camera matrix and nothing else.
nlohmann::json matrixAlone(std::string_view text)
{
  nlohmann::json numbers = nlohmann::json::array();
  constexpr const char* separators = " \t\r\n,;[]";
  while ((text.remove_prefix(std::min(text.find_first_not_of(separators), text.size())), !text.empty()))
  {
    const std::string_view word = text.substr(0, text.find_first_of(separators));
    double value = 0.0;
    if (!parseNumber(word, value) || !std::isfinite(value))
    {
      return nullptr;
    }
    numbers.push_back(value);
    text.remove_prefix(word.size());
  }
  return numbers.empty() ? nlohmann::json() : nlohmann::json{ { "camera_matrix", numbers } };
}

/// Whether a text begins with a section of an INI file, as ROS's ost.txt does.
bool isINI(const std::string& text)
{
  TextLines lines(text);
  const std::string_view first = lines.next() ? bareText(lines.line()) : std::string_view();
  return first.size() > 2 && first.front() == '[' && first.back() == ']' &&
         std::isalpha(static_cast<unsigned char>(first[1]));
}

Camera cameraOf(const std::string& path, const nlohmann::json& entries)
{
  if (!keyOf(entries, { "radial_distortion" }).empty())
  {
    failCamera(path,
      "is one of MATLAB's, which count pixels from 1 and have the lens in two lists: give fx, fy, cx and cy "
      "less 1, and dist, k1 k2 p1 p2 k3");
  }
  requirePinhole(path, entries);
  requireWholeImage(path, entries);
  const std::optional<Intrinsics> intrinsics = intrinsicsOf(path, entries);
  if (!intrinsics)
  {
    failCamera(path, "has neither a camera_matrix nor all of fx, fy, cx and cy: it is not a camera's calibration");
  }
  Camera camera;
  camera.fx = intrinsics->fx;
  camera.fy = intrinsics->fy;
  camera.cx = intrinsics->cx;
  camera.cy = intrinsics->cy;
  const std::array<int, 2> size = sizeOf(path, entries);
  camera.width = size[0];
  camera.height = size[1];
  const double width = std::max<double>(camera.width, 2.0 * camera.cx);
  const double focal = std::min(camera.fx, camera.fy);
  const double least = camera.width > 0 ? std::min(LeastFocalPixels, 0.5 * camera.width) : LeastFocalPixels;
  if (focal > 0.0 && focal < std::max(LeastFocalLength * width, least))
  {
    char told[96];
    std::snprintf(told, sizeof told, "%.4g, where the image is about %.0f wide", focal, width);
    failCamera(path, std::string("has the focal length ") + told + ": give it in pixels, not in mm");
  }
  camera.distortion = distortionOf(path, entries);
  camera.T_camera_scene = placeOf(path, entries);
  return camera;
}
}

CameraFile readCamera(const std::string& path)
{
  const std::string bytes = readText(path);
  if (bytes.size() > MostBytes || bytes.find('\0') != std::string::npos)
  {
    failCamera(path, "is not a text of a camera's calibration");
  }
  if (isINI(bytes))
  {
    failCamera(path, "is an INI text, which is not read: give it as YAML, XML or JSON, of ROS ost.yaml");
  }
  const nlohmann::json matrix = matrixAlone(bareText(bytes));
  const nlohmann::json entries = entriesOfCamera(path, matrix.is_null() ? parseStorage(path, bytes) : matrix);
  CameraFile result;
  result.camera = cameraOf(path, entries);
  const bool isPlaced = !keyOf(entries, { "T_camera_scene", "T", "tvec", "T_cn_cnm1" }).empty();
  result.doubtOfPlace =
    isPlaced ? doubtOfUnit(result.camera.T_camera_scene.translation().norm()) : doubtOfPlace(entries);
  try
  {
    requireCamera(result.camera);
  }
  catch (const Error& error)
  {
    throw Error("The camera file '" + path + "' does not fit. " + error.what());
  }
  if (const auto scale = find(path, entries, { "depth_scale" }, 1, 1); !scale.empty())
  {
    result.depthScale = scale.front();
    if (!(result.depthScale > 0.0))
    {
      failCamera(path, "has a depth_scale that is not positive");
    }
  }
  return result;
}

Camera readImageCamera(const std::string& path)
{
  const CameraFile file = readCamera(path);
  if (!file.doubtOfPlace.empty())
  {
    failCamera(path, file.doubtOfPlace);
  }
  return file.camera;
}
}
