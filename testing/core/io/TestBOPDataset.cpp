// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "TestImages.h"
#include "io/BOPDataset.h"

#include <cmath>

namespace
{
const std::string cameras = R"({ "10": { "cam_K": [100, 0, 1, 0, 200, 0.5, 0, 0, 1], "depth_scale": 0.1,
  "cam_R_w2c": [1, 0, 0, 0, 1, 0, 0, 0, 1] }, "2": { "cam_K": [100, 0, 1, 0, 200, 0.5, 0, 0, 1] } })";
const std::string truth = R"({ "2": [
  { "obj_id": 5, "cam_R_m2c": [0, -1, 0, 1, 0, 0, 0, 0, 1], "cam_t_m2c": [1, 2, 300] },
  { "obj_id": 6, "cam_R_m2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_m2c": [0, 0, 400] } ] })";
const std::string info = R"({ "2": [ { "visib_fract": 0.75, "bbox_obj": [1, 2, 3, 4] }, { "visib_fract": 0 } ] })";

/// Two scenes; the first one has two images with everything.
void writeDataset(const files::Folder& folder)
{
  const cv::Mat depths = (cv::Mat_<std::uint16_t>(2, 3) << 0, 5000, 65535, 1, 2, 3);
  folder.write("test/000003/scene_camera.json", cameras);
  folder.write("test/000003/scene_gt.json", truth);
  folder.write("test/000003/scene_gt_info.json", info);
  folder.write("test/000003/depth/000002.png", images::encoded(".png", depths));
  folder.write("test/000003/depth/000010.tif", images::encoded(".tif", depths));
  folder.write("test/000003/rgb/000002.png", images::encoded(".png", cv::Mat(2, 3, CV_8UC3, cv::Scalar(1, 2, 3))));
  folder.write("test/000003/gray/000010.tif", images::encoded(".tif", cv::Mat(2, 3, CV_8UC1, cv::Scalar(9))));
  folder.write("test/000012/scene_camera.json", R"({ "0": { "cam_K": [100, 0, 1, 0, 200, 0.5, 0, 0, 1] } })");
  folder.write("test/000012/depth/000000.png", images::encoded(".png", depths));
  folder.write("test/notes/scene_camera.json", cameras); // no scene: its name is no number
  folder.write("train/000000/scene_camera.json", cameras);
  folder.write("camera.json", "{}");
}

std::string listed(const std::vector<meam::BOPImage>& all)
{
  std::string text;
  for (const meam::BOPImage& image : all)
  {
    text += std::to_string(image.sceneId) + "/" + std::to_string(image.imageId) + " ";
  }
  return text;
}
}

TEST(BOPDataset, scenesAndImagesInTheOrderOfTheirNumbers)
{
  const files::Folder folder;
  writeDataset(folder);
  const std::string both = "3/2 3/10 12/0 ";
  EXPECT_EQ(listed(meam::listBOPImages(folder.path())), both);
  EXPECT_EQ(listed(meam::listBOPImages(folder.path() + "/")), both);
  EXPECT_EQ(listed(meam::listBOPImages(folder.path("camera.json"))), both) << "a file of the dataset";
  EXPECT_EQ(listed(meam::listBOPImages(folder.path("test"))), both) << "a split";
  EXPECT_EQ(listed(meam::listBOPImages(folder.path("test/000012"))), "12/0 ") << "a scene";
  EXPECT_EQ(listed(meam::listBOPImages(folder.path("test/000003/scene_camera.json"))), "3/2 3/10 ");
  EXPECT_EQ(listed(meam::listBOPImages(folder.path("test/notes"))), "0/2 0/10 ") << "a scene of another name";
  EXPECT_EQ(listed(meam::listBOPImages(folder.path(), "train")), "0/2 0/10 ");
}

TEST(BOPDataset, depthAndImage)
{
  const files::Folder folder;
  writeDataset(folder);
  const auto all = meam::listBOPImages(folder.path());
  EXPECT_EQ(meam::readBOPSize(all[0]), (std::array<int, 2>{ 3, 2 }));
  const meam::OrganizedCloud whole = meam::readBOPDepth(all[0]);
  EXPECT_FLOAT_EQ(whole.points[1].z(), 5000.0f) << "without a scale the depth is in mm";
  EXPECT_TRUE(std::isnan(whole.points[0].z()));
  const meam::OrganizedCloud tenths = meam::readBOPDepth(all[1]);
  EXPECT_FLOAT_EQ(tenths.points[1].z(), 500.0f);
  EXPECT_TRUE(std::isnan(tenths.points[2].z())) << "65535 stands for what was not measured";
  EXPECT_EQ(meam::readBOPColors(all[0], whole)->pixels[0], 3) << "red first";
  EXPECT_EQ(meam::readBOPColors(all[1], tenths)->pixels, std::vector<std::uint8_t>(6, 9));
  EXPECT_FALSE(meam::readBOPColors(all[2], whole)) << "no image is no error";
}

TEST(BOPDataset, truePoses)
{
  const files::Folder folder;
  writeDataset(folder);
  const auto all = meam::listBOPImages(folder.path());
  const auto instances = meam::readBOPTruth(all[0]);
  ASSERT_EQ(instances.size(), 2u);
  EXPECT_EQ(instances[0].objectId, 5);
  EXPECT_EQ(instances[0].pose.T_scene_model * Eigen::Vector3d(10, 0, 0), Eigen::Vector3d(1, 12, 300));
  EXPECT_EQ(instances[0].pose.visibleFraction, 0.75);
  EXPECT_EQ(instances[1].objectId, 6);
  EXPECT_TRUE(meam::readBOPTruth(all[1]).empty()) << "an image that is not in the file";
  EXPECT_TRUE(meam::readBOPTruth(all[2]).empty()) << "a scene without the file";
  std::filesystem::remove(folder.path("test/000003/scene_gt_info.json"));
  EXPECT_EQ(meam::readBOPTruth(all[0])[0].pose.visibleFraction, 0.0);
}

TEST(BOPDataset, badDatasets)
{
  const files::Folder folder;
  writeDataset(folder);
  const auto listing = [&](const std::string& text)
  {
    folder.write("bad/000001/scene_camera.json", text);
    return files::errorOf([&] { meam::listBOPImages(folder.path("bad")); });
  };
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::listBOPImages("/no/such/folder"); }), "/no/such/folder"));
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::listBOPImages(folder.path(), "val"); }), "'val'"));
  EXPECT_TRUE(files::contains(listing("{"), "not JSON"));
  EXPECT_TRUE(files::contains(listing("[]"), "not a JSON object"));
  EXPECT_TRUE(files::contains(listing("{}"), "no images"));
  EXPECT_TRUE(files::contains(listing(R"({ "one": {} })"), "'one'"));
  EXPECT_TRUE(files::contains(listing(R"({ "-1": {} })"), "'-1'"));
  EXPECT_TRUE(files::contains(listing(R"({ "1": 5 })"), "cam_K"));
  EXPECT_TRUE(files::contains(listing(R"({ "1": { "cam_K": [1, 2] } })"), "2 numbers as cam_K"));
  EXPECT_TRUE(files::contains(listing(R"({ "1": { "cam_K": [1, 0, 0, 0, 0, 0, 0, 0, 1] } })"), "focal length"));
  EXPECT_TRUE(
    files::contains(listing(R"({ "1": { "cam_K": [1, 0, 0, 0, 1, 0, 0, 0, 1], "depth_scale": 0 } })"), "depth scale"));

  const auto all = meam::listBOPImages(folder.path());
  const auto truthError = [&](const std::string& gt, const std::string& gtInfo)
  {
    folder.write("test/000003/scene_gt.json", gt);
    folder.write("test/000003/scene_gt_info.json", gtInfo);
    return files::errorOf([&] { meam::readBOPTruth(all[0]); });
  };
  EXPECT_TRUE(files::contains(truthError(R"({ "2": {} })", info), "no list of objects"));
  EXPECT_TRUE(files::contains(truthError(R"({ "2": [5] })", "{}"), "obj_id"));
  EXPECT_TRUE(files::contains(truthError(R"({ "2": [{ "obj_id": -3 }] })", "{}"), "obj_id"));
  EXPECT_TRUE(files::contains(truthError(R"({ "2": [{ "obj_id": 1, "cam_R_m2c": [1, 0, 0, 0, 2, 0, 0, 0, 1],
    "cam_t_m2c": [0, 0, 0] }] })",
                                "{}"),
    "not a rotation"));
  EXPECT_TRUE(files::contains(truthError(truth, R"({ "2": [{}] })"), "has 1 objects"));
  EXPECT_TRUE(files::contains(truthError(truth, R"({ "2": [{}, {}] })"), "visib_fract"));

  std::filesystem::remove_all(folder.path("test/000003/depth"));
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::readBOPDepth(all[0]); }), "no depth image number 2"));
  folder.write("test/000003/rgb/000002.png", images::encoded(".png", cv::Mat::zeros(5, 5, CV_8UC3)));
  meam::OrganizedCloud cloud;
  cloud.width = 3;
  cloud.height = 2;
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::readBOPColors(all[0], cloud); }), "5 x 5"));
}
