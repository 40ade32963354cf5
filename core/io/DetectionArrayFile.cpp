// SPDX-License-Identifier: BSD-3-Clause
#include "io/DetectionArrayFile.h"

#include "io/parsing/FileBytes.h"
#include "scene/Units.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>

namespace meam
{
namespace
{
using JSON = nlohmann::ordered_json;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
constexpr double LastStamp = 2147483648.0; // seconds since 1970: 32 bits with a sign

JSON jsonOf(const Eigen::Vector3d& vector) { return { { "x", vector.x() }, { "y", vector.y() }, { "z", vector.z() } }; }

/// A pose in metres; the quaternion with w >= 0.
JSON jsonOf(const Eigen::Isometry3d& pose)
{
  Eigen::Quaterniond q = Eigen::Quaterniond(pose.linear()).normalized();
  q.coeffs() *= q.w() < 0.0 ? -1.0 : 1.0;
  return { { "position", jsonOf(Eigen::Vector3d(pose.translation() / Metre)) },
    { "orientation", { { "x", q.x() }, { "y", q.y() }, { "z", q.z() }, { "w", q.w() } } } };
}

/// Of (rotation vector, translation in mm) about the part's middle that of (translation in metres, rotation vector)
/// about its origin: the origin moves by t + w x r, with r from the middle to it.
Matrix6 aboutOrigin(const Matrix6& covariance, const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& middle)
{
  const Eigen::Vector3d r = T_scene_model.linear() * -middle;
  Matrix6 toOrigin = Matrix6::Zero();
  toOrigin.topLeftCorner<3, 3>() << 0.0, r.z(), -r.y(), -r.z(), 0.0, r.x(), r.y(), -r.x(), 0.0;
  toOrigin.topRightCorner<3, 3>().setIdentity();
  toOrigin.topRows<3>() /= Metre;
  toOrigin.bottomLeftCorner<3, 3>().setIdentity();
  return toOrigin * covariance * toOrigin.transpose();
}

JSON resultOf(const PoseRow& row, const std::optional<PartExtent>& part)
{
  const Matrix6 covariance =
    part && row.covariance ? aboutOrigin(*row.covariance, row.T_scene_model, part->middle) : Matrix6::Zero();
  JSON result;
  result["hypothesis"] = { { "class_id", std::to_string(row.objectId) }, { "score", row.score } };
  result["pose"]["pose"] = jsonOf(row.T_scene_model);
  result["pose"]["covariance"] = std::vector<double>(covariance.data(), covariance.data() + 36); // symmetric
  return result;
}

JSON boxOf(const PoseRow& row, const std::optional<PartExtent>& part)
{
  Eigen::Isometry3d middle = row.T_scene_model;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  if (part)
  {
    middle.translate(part->box.center());
    size = part->box.sizes() / Metre;
  }
  return { { "center", jsonOf(middle) }, { "size", jsonOf(size) } };
}
}

void writeDetections(const std::string& path, const std::vector<PoseRow>& poses, const std::optional<PartExtent>& part,
  const DetectionArrayHeader& header)
{
  if (!(header.stamp >= 0.0 && header.stamp < LastStamp))
  {
    throw Error("The file '" + path + "' was not written: the stamp has to be seconds since 1970, or 0.");
  }
  JSON head;
  const double seconds = std::floor(header.stamp);
  head["stamp"] = { { "sec", static_cast<std::int64_t>(seconds) },
    { "nanosec", static_cast<std::int64_t>((header.stamp - seconds) * 1e9) } };
  head["frame_id"] = header.frame;
  JSON file;
  file["header"] = head;
  file["detections"] = JSON::array();
  int place = 0;
  for (const PoseRow& row : poses)
  {
    ++place;
    if (!row.T_scene_model.matrix().allFinite() || !std::isfinite(row.score))
    {
      throw Error("The file '" + path + "' was not written: a pose has a value that is not a number.");
    }
    JSON detection;
    detection["header"] = head;
    detection["results"] = JSON::array({ resultOf(row, part) });
    detection["bbox"] = boxOf(row, part);
    detection["id"] = std::to_string(row.rank > 0 ? row.rank : place);
    file["detections"].push_back(detection);
  }
  writeFile(path, file.dump(1, ' ', false, JSON::error_handler_t::replace) + "\n");
}
}
