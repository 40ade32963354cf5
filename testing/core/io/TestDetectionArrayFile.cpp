// SPDX-License-Identifier: BSD-3-Clause
#include "io/DetectionArrayFile.h"
#include "TestFiles.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace
{
/// A quarter turn about z and a shift of 100, 200 and 300 mm.
meam::PoseRow turnedRow()
{
  meam::PoseRow row;
  row.objectId = 7;
  row.score = 0.75;
  row.T_scene_model.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  row.T_scene_model.translation() << 100, 200, 300;
  return row;
}

/// A box of 20 x 40 x 60 mm whose corner is the origin.
meam::PartExtent box()
{
  meam::PartExtent part;
  part.box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(20, 40, 60));
  part.middle = part.box.center();
  return part;
}

nlohmann::json written(const std::vector<meam::PoseRow>& poses, const std::optional<meam::PartExtent>& part = {},
  const meam::DetectionArrayHeader& header = {})
{
  const files::Folder folder;
  meam::writeDetections(folder.path("a.detections.json"), poses, part, header);
  return nlohmann::json::parse(meam::readFile(folder.path("a.detections.json")));
}

Eigen::Vector3d vectorOf(const nlohmann::json& json)
{
  return { json["x"].get<double>(), json["y"].get<double>(), json["z"].get<double>() };
}
}

TEST(DetectionArrayFile, hasTheShapeOfTheMessage)
{
  meam::DetectionArrayHeader header;
  header.frame = "sensor";
  header.stamp = 12.5;
  const nlohmann::json file = written({ turnedRow(), {} }, {}, header);
  EXPECT_EQ(file.size(), 2u);
  const nlohmann::json head{ { "stamp", { { "sec", 12 }, { "nanosec", 500000000 } } }, { "frame_id", "sensor" } };
  EXPECT_EQ(file["header"], head);
  ASSERT_EQ(file["detections"].size(), 2u);
  const nlohmann::json& first = file["detections"][0];
  EXPECT_EQ(first.size(), 4u);
  EXPECT_EQ(first["header"], head);
  EXPECT_EQ(first["id"], "1");
  EXPECT_EQ(file["detections"][1]["id"], "2");
  ASSERT_EQ(first["results"].size(), 1u);
  const nlohmann::json& result = first["results"][0];
  EXPECT_EQ(result["hypothesis"], nlohmann::json({ { "class_id", "7" }, { "score", 0.75 } }));
  EXPECT_EQ(vectorOf(result["pose"]["pose"]["position"]), Eigen::Vector3d(0.1, 0.2, 0.3)); // metres
  const nlohmann::json& q = result["pose"]["pose"]["orientation"];
  EXPECT_TRUE(vectorOf(q).isApprox(Eigen::Vector3d(0, 0, std::sqrt(0.5)), 1e-15));
  EXPECT_NEAR(q["w"].get<double>(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(result["pose"]["covariance"], nlohmann::json(std::vector<double>(36, 0.0)));
  EXPECT_EQ(vectorOf(first["bbox"]["size"]), Eigen::Vector3d(0, 0, 0));
  EXPECT_TRUE(written({})["detections"].empty());
}

TEST(DetectionArrayFile, theBoxTurnsWithThePart)
{
  const nlohmann::json file = written({ turnedRow() }, box());
  const nlohmann::json& found = file["detections"][0]["bbox"];
  EXPECT_TRUE(vectorOf(found["center"]["position"]).isApprox(Eigen::Vector3d(0.08, 0.21, 0.33), 1e-12));
  EXPECT_TRUE(vectorOf(found["size"]).isApprox(Eigen::Vector3d(0.02, 0.04, 0.06), 1e-12));
  EXPECT_NEAR(found["center"]["orientation"]["z"].get<double>(), std::sqrt(0.5), 1e-15);
}

TEST(DetectionArrayFile, theCovarianceIsAboutTheOrigin)
{
  // 2 mm of the middle along the scene's x, and 0.1 radians about its z, independent of each other. From the middle to
  // the origin are 20, -10 and -30 mm, so that this turn moves it by 1 mm along x and by 2 mm along y.
  meam::PoseRow row = turnedRow();
  row.covariance.emplace().setZero();
  (*row.covariance)(2, 2) = 0.01;
  (*row.covariance)(3, 3) = 4.0;
  const nlohmann::json file = written({ row }, box());
  const auto values = file["detections"][0]["results"][0]["pose"]["covariance"].get<std::vector<double>>();
  const Eigen::Matrix<double, 6, 6> found = Eigen::Map<const Eigen::Matrix<double, 6, 6>>(values.data());
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  expected(0, 0) = (4.0 + 1.0) * 1e-6;
  expected(1, 1) = 4.0 * 1e-6;
  expected(0, 1) = expected(1, 0) = 1.0 * 2.0 * 1e-6;
  expected(5, 5) = 0.01;
  expected(0, 5) = expected(5, 0) = 0.1 * 1e-3;
  expected(1, 5) = expected(5, 1) = 0.2 * 1e-3;
  EXPECT_TRUE(found.isApprox(expected, 1e-12)) << found;
}

TEST(DetectionArrayFile, whatIsNotANumberIsNotWritten)
{
  const files::Folder folder;
  const std::string path = folder.write("a.detections.json", "old");
  meam::PoseRow broken;
  broken.T_scene_model.translation().x() = std::nan("");
  EXPECT_THROW(meam::writeDetections(path, { broken }), meam::Error);
  meam::DetectionArrayHeader header;
  header.stamp = -1.0;
  EXPECT_THROW(meam::writeDetections(path, {}, {}, header), meam::Error);
  EXPECT_EQ(meam::readFile(path), "old");
}
