// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "io/CameraFile.h"

namespace
{
const files::Reader readCamera{ meam::readCamera };
const files::Reader readImageCamera{ meam::readImageCamera };

const std::string yaml = R"(%YAML:1.0
---
calibration_time: "Mon 05 Feb 2024"
image_width: 1280
image_height: 1024
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1200.5, 0., 640.25, 0., 1190., 511.5, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.1e-01, 0.13, 0.0011, -0.0007, -0.035 ]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 0., 0., -1., 0., 1., 0., 1., 0., 0. ]
T: [ 400, 0, -100 ]
)";

const std::string xml = R"(<?xml version="1.0"?>
<opencv_storage>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt>
  <data>800. 0. 320. 0. 801. 240. 0. 0. 1.</data></camera_matrix>
<dist_coeffs type_id="opencv-matrix"><rows>1</rows><cols>4</cols><dt>d</dt>
  <data>0.1 0.2 0.3 0.4</data></dist_coeffs>
<depth_scale>0.1</depth_scale>
</opencv_storage>
)";

const std::string json = R"({ "camera_matrix": { "type_id": "opencv-matrix", "rows": 3, "cols": 3, "dt": "d",
  "data": [ 800.0, 0.0, 320.0, 0.0, 801.0, 240.0, 0.0, 0.0, 1.0 ] }, "dist_coeffs": [ 0, 0, 0, 0, 0, 0, 0, 0 ],
  "image_width": 640, "image_height": 480,
  "T_camera_scene": [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]], "name": "left", "roi": { "x": 3 } })";

const std::string bop = R"( {"cx": 325.26, "cy": 242.05, "depth_scale": 0.1, "fx": 572.41, "fy": 573.57, "height": 480,
  "width": 640})";

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  text.replace(text.find(from), from.size(), to);
  return text;
}
}

TEST(CameraFile, everyForm)
{
  using Lens = std::array<double, 8>;
  const Lens none{};
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity(), beside(Eigen::Translation3d(5, 6, 7));
  Eigen::Isometry3d turned(Eigen::Translation3d(400, 0, -100));
  turned.linear() << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  const struct
  {
    const char* name;
    std::string text;
    std::array<int, 2> size;
    std::array<double, 4> matrix;
    Lens lens;
    Eigen::Isometry3d T;
    double scale;
  } forms[] = { { "YAML of OpenCV", yaml, { 1280, 1024 }, { 1200.5, 1190.0, 640.25, 511.5 },
                  { -0.21, 0.13, 0.0011, -0.0007, -0.035 }, turned, 1.0 },
    { "XML of OpenCV, whose size is not known", xml, { 0, 0 }, { 800, 801, 320, 240 }, { 0.1, 0.2, 0.3, 0.4 }, identity,
      0.1 },
    { "with a mark of its order of bytes", "\xef\xbb\xbf" + xml, { 0, 0 }, { 800, 801, 320, 240 },
      { 0.1, 0.2, 0.3, 0.4 }, identity, 0.1 },
    { "JSON of OpenCV", json, { 640, 480 }, { 800, 801, 320, 240 }, none, beside, 1.0 },
    { "YAML without OpenCV's types",
      "image_width: 640 # pixels\ncamera_name: left\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [800, 0, 320,\n         0, 801, 240,\n         0, 0, 1]\n"
      "rectification_matrix:\n  data: [1, 2]\nT_camera_scene: [[1, 0, 0, 5],\n"
      "  [0, 1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]]\nimage_height: 480\n",
      { 640, 480 }, { 800, 801, 320, 240 }, none, beside, 1.0 },
    { "YAML of lists by lines",
      "image_width: 640\nimage_height: 480\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data:\n  - 800\n"
      "  - 0.0\n  - 320\n  - 0\n  - 801.0\n  - 240\n  - 0\n  - 0\n  - 1\ndistortion_coefficients:\n"
      "  data:\n    - -0.3\n    - 1.0e-1\n    - 0\n    - +0.002\n    - 0\n",
      { 640, 480 }, { 800, 801, 320, 240 }, { -0.3, 0.1, 0, 0.002, 0 }, identity, 1.0 },
    { "YAML in braces",
      "{ image_width: 640, image_height: 480,\n  camera_matrix: {rows: 3, cols: 3, data: [800, 0, 320, 0, 801, 240, 0, "
      "0, 1]}}\n",
      { 640, 480 }, { 800, 801, 320, 240 }, none, identity, 1.0 },
    { "BOP", bop, { 640, 480 }, { 572.41, 573.57, 325.26, 242.05 }, none, identity, 0.1 } };
  for (const auto& [name, text, size, matrix, lens, T, scale] : forms)
  {
    SCOPED_TRACE(name);
    const meam::CameraFile file = readCamera(text);
    const meam::Camera& camera = file.camera;
    EXPECT_EQ((std::array<int, 2>{ camera.width, camera.height }), size);
    EXPECT_EQ((std::array<double, 4>{ camera.fx, camera.fy, camera.cx, camera.cy }), matrix);
    EXPECT_EQ(camera.distortion, lens);
    EXPECT_EQ(camera.T_camera_scene.matrix(), T.matrix());
    EXPECT_EQ(file.depthScale, scale);
  }
}

TEST(CameraFile, placesBesideTheSensor)
{
  const auto with = [](const std::string& place) { return replaced(bop, "\"fy\"", place + ", \"fy\""); };
  const auto placeOf = [&](const std::string& place) { return readCamera(with(place)).camera.T_camera_scene; };
  Eigen::Isometry3d turned(Eigen::Translation3d(50, 0, -100));
  turned.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_TRUE(placeOf(R"("rvec": [[0], [0], [1.5707963267948966]], "tvec": [50, 0, -100])").isApprox(turned));
  EXPECT_TRUE(
    placeOf(R"("T_cn_cnm1": [[0, -1, 0, 0.05], [1, 0, 0, 0], [0, 0, 1, -0.1], [0, 0, 0, 1]])").isApprox(turned));
  EXPECT_TRUE(placeOf(R"("rvec": [0, 0, 0], "tvec": [0, 0, 0])").matrix().isIdentity());
  for (const char* same : { R"("extrinsic": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])",
         R"("translation": {"x": 0, "y": 0, "z": 0}, "rotation": {"x": 0, "y": 0, "z": 0, "w": 1})" })
  {
    EXPECT_TRUE(placeOf(same).matrix().isIdentity()) << same;
  }
  readCamera.fails(with(R"("rvec": [0, 0, 1])"), "rvec and tvec");
  readImageCamera.fails(
    with(R"("extrinsic": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.05, 0, 0, 1])"), "place as extrinsic, but");
  readImageCamera.fails(with(R"("translation": [50, 0, 0], "rotation": [0, 0, 0.1, 0.995])"), "place as rotation, but");
  const std::string ofDepth = with(R"("extrinsic": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.05, 0, 0, 1])");
  EXPECT_TRUE(readCamera(ofDepth).camera.T_camera_scene.matrix().isIdentity()) << "where a sensor is does not matter";
  EXPECT_TRUE(readImageCamera(bop).T_camera_scene.matrix().isIdentity());
  readImageCamera.fails(with(R"("R": [1, 0, 0, 0, 1, 0, 0, 0, 1], "T": [0.05, 0, 0])"), "0.05 mm from the scan's");
}

TEST(CameraFile, lensesOfROS)
{
  const auto text = [](const std::string& model, const std::string& numbers)
  {
    return "image_width: 640\nimage_height: 480\ncamera_name: left\ncamera_matrix:\n  data: [800, 0, 320, 0, 801, 240, "
           "0, 0, "
           "1]\ndistortion_model: " +
           model + "\ndistortion_coefficients:\n  data: [" + numbers + "]\n";
  };
  EXPECT_EQ(readCamera(text("plumb_bob", "1, 2, 3, 4, 5")).camera.distortion, (std::array<double, 8>{ 1, 2, 3, 4, 5 }));
  EXPECT_EQ(readCamera(text("rational_polynomial", "1, 2, 3, 4, 5, 6, 7, 8")).camera.distortion,
    (std::array<double, 8>{ 1, 2, 3, 4, 5, 6, 7, 8 }));
  EXPECT_EQ(readCamera(text("equidistant", "0, 0, 0, 0")).camera.distortion, (std::array<double, 8>{}));
  readCamera.fails(text("equidistant", "0.1, 0, 0, 0"), "a lens of the model 'equidistant', which is not read");
  readCamera.fails(text("rational_polynomial", "1, 2, 3, 4, 5"), "5 numbers of its lens's distortion instead of 8");
  readCamera.fails(text("plumb_bob", "1, 2"), "2 numbers");
  readCamera.fails(text("plumb_bob", "1, 0, 0, 0, 0, 1, 0, 0"), "name it rational_polynomial");
  EXPECT_EQ(readCamera(text("plumb_bob", "1, 2, 3, 4, 5, 0, 0, 0")).camera.distortion,
    (std::array<double, 8>{ 1, 2, 3, 4, 5 }));
  readCamera.fails(text("plumb_bob", "0, 0, 0, 0, 0") + "\nxi: 0.5", "a lens of the model 'omni', which is not read");
  readCamera.fails(text("plumb_bob", "0, 0, 0, 0, 0") + "\nskew: 3", "has a skew, which is not read");
  // camera_info, with a rectification R and no T.
  const meam::Camera info =
    readCamera("height: 480\nwidth: 640\ndistortion_model: plumb_bob\nD: [0.1, 0, 0, 0, 0]\nK: "
               "[800.0, 0.0, 320.0, 0.0, 801.0, 240.0, 0.0, 0.0, 1.0]\nR: [0.9, 0.1, 0, 0, 1, 0, "
               "0, 0, 1]\nP: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\n")
      .camera;
  EXPECT_EQ(info.width, 640);
  EXPECT_EQ(info.cy, 240.0);
  EXPECT_EQ(info.distortion[0], 0.1);
}

TEST(CameraFile, otherPrograms)
{
  const auto isCamera = [](const meam::Camera& camera)
  {
    return camera.width == 640 && camera.height == 480 && camera.fx == 800.0 && camera.fy == 801.0 &&
           camera.cx == 320.0 && camera.cy == 240.0;
  };
  const std::string open3d = R"({ "width": 640, "height": 480,
    "intrinsic_matrix": [ 800.0, 0.0, 0.0, 0.0, 801.0, 0.0, 320.0, 240.0, 1.0 ] })";
  EXPECT_TRUE(isCamera(readCamera(open3d).camera));
  EXPECT_TRUE(isCamera(
    readCamera(R"({ "class_name": "PinholeCameraParameters", "extrinsic": [1, 0], "intrinsic": )" + open3d + "}")
      .camera));
  const std::string realSense = R"({ "width": 640, "height": 480, "fx": 800.0, "fy": 801.0, "ppx": 320.0, "ppy": 240.0,
    "model": "distortion.inverse_brown_conrady", "coeffs": [ 0.0, 0.0, 0.0, 0.0, 0.0 ] })";
  EXPECT_TRUE(isCamera(readCamera(realSense).camera));
  readCamera.fails(replaced(realSense, "0.0, 0.0", "0.1, 0.0"), "'distortioninversebrownconrady'");
  const std::string other = replaced(realSense, "inverse_brown", "brown");
  EXPECT_EQ(readCamera(replaced(other, "0.0, 0.0", "0.1, 0.0")).camera.distortion[0], 0.1);
  const std::string kalibr =
    "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0.1, 0.2, 0.3, 0.4]\n  distortion_model: "
    "radtan\n  intrinsics: [800, 801, 320, 240]\n  resolution: [640, 480]\n";
  EXPECT_TRUE(isCamera(readCamera(kalibr).camera));
  EXPECT_EQ(readCamera(kalibr).camera.distortion[3], 0.4);
  readCamera.fails(replaced(kalibr, "radtan", "equidistant"), "equidistant");
  readCamera.fails(kalibr + replaced(kalibr, "cam0", "cam1"), "has 2 cameras");
}

TEST(CameraFile, intrinsicsAtAnyPlaceOfAFile)
{
  const auto isRead = [](const std::string& text)
  {
    const meam::Camera camera = readCamera(text).camera;
    EXPECT_EQ((std::array<double, 4>{ camera.fx, camera.fy, camera.cx, camera.cy }),
      (std::array<double, 4>{ 800, 801, 320, 240 }))
      << text;
    return camera;
  };
  const std::string matrix = "[[800, 0, 320], [0, 801, 240], [0, 0, 1]]";
  const std::array<double, 8> lens{ 0.1, 0.2, 0.3, 0.4, 0.5 };
  // Zivid's, Orbbec's, and of a list.
  EXPECT_EQ(isRead("CameraIntrinsics:\n  CameraMatrix: {CX: 320, CY: 240, FX: 800, FY: 801}\n"
                   "  Distortion: {K1: 0.1, K2: 0.2, K3: 0.5, P1: 0.3, P2: 0.4}\n")
              .distortion,
    lens);
  EXPECT_EQ(isRead(R"({"depth_intrinsic": {"fx": 800, "fy": 801, "cx": 320, "cy": 240},
    "depth_distortion": {"k1": 0.1, "k2": 0.2, "k3": 0.5, "p1": 0.3, "p2": 0.4}})")
              .distortion,
    lens);
  EXPECT_EQ(isRead("[{\"K\": " + matrix + ", \"width\": 640}]").width, 640);
  EXPECT_EQ(isRead("<s><CameraIntrinsics><CameraMatrix><FX>800</FX><FY>801</FY><CX>320</CX><CY>240</CY></CameraMatrix>"
                   "</CameraIntrinsics><width>640</width></s>")
              .width,
    640);
  readCamera.fails(R"({"depth": {"fx": 1, "fy": 1, "cx": 1, "cy": 1}, "color": {"fx": 1}})", "has 2 cameras");
  // By rows or columns, with a column more, and of pairs.
  isRead("intrinsic_matrix: " + matrix);
  isRead("camera_matrix: [[800, 0, 0], [0, 801, 0], [320, 240, 1]]");
  isRead("intrinsics: [[800, 0, 320, 0], [0, 801, 240, 0], [0, 0, 1, 0]]");
  isRead("focal_length: [800, 801]\nprincipal_point: [320, 240]");
  readCamera.fails("K: [1, 2, 3, 4, 5]", "5 numbers as K instead of 9");
  // Numbers alone.
  isRead("800 0 320\n0 801 240\n0 0 1\n");
  isRead("800, 0, 320, 0\n0, 801, 240, 0\n0, 0, 1, 0\n0, 0, 0, 1\n");
  isRead(matrix);
  readCamera.fails("# oST version 5.0 parameters\n\n[image]\n\nwidth\n640\n", "INI");
  // Sizes.
  for (const std::string size : { "image_size: [640, 480]", "resolution: {width: 640, height: 480}",
         "CameraResolution: {Width: 640, Height: 480}" })
  {
    const meam::Camera camera = isRead("K: " + matrix + "\n" + size);
    EXPECT_EQ((std::array<int, 2>{ camera.width, camera.height }), (std::array<int, 2>{ 640, 480 })) << size;
  }
  EXPECT_EQ(isRead("K: " + matrix + "\nresolution: [480, 640]").width, 480) << "as the file has it";
  EXPECT_EQ(
    isRead("{\"Width\": 1920, \"model\": \"M2\", \"depth\": {\"K\": " + matrix + ", \"width\": 640}}").width, 640)
    << "the camera's own before what it stands in";
  readCamera.fails("K: " + matrix + "\nresolution: {x: 640, y: 480}", "a resolution without a width and a height");
  readCamera.fails("fx: 4.8\nfy: 4.8\ncx: 320\ncy: 240", "focal length 4.8");
  readCamera.fails("focal_length: 8.5\nprincipal_point: [3.6, 2.4]", "focal length 8.5");
  EXPECT_EQ(readCamera("fx: 10\nfy: 10\ncx: 1\ncy: 1\nwidth: 4\nheight: 3").camera.fx, 10.0) << "a small image";
  readCamera.fails("fx: 8.5\nfy: 8.5\ncx: 80\ncy: 60\nwidth: 160\nheight: 120", "focal length 8.5");
  readCamera.fails("fx: 25\nfy: 25\ncx: 320\ncy: 240\nwidth: 640\nheight: 480", "focal length 25");
}

TEST(CameraFile, whatIsTakenForNoCamera)
{
  const std::string matrix = "[[800, 0, 320], [0, 801, 240], [0, 0, 1]]";
  readCamera.fails("1 0 0 100\n0 1 0 200\n0 0 1 300\n0 0 0 1\n", "more than a camera matrix");
  readCamera.fails("K: [[800, 0, 320, -40000], [0, 801, 240, 0], [0, 0, 1, 0]]", "more than a camera matrix as K");
  readCamera.fails(
    R"({"fx": 800, "fy": 801, "cx": 320, "cy": 240, "k": [0.1, 0.02, 0.003, 0.0004]})", "4 numbers as k instead of 9");
  readCamera.fails("<s><camera><fx>800</fx><k1>.1</k1></camera><camera><fx>1200</fx></camera></s>", "has 2 cameras");
  readCamera.fails("<c><f>3700</f><cx>12.3</cx><cy>-5.6</cy></c>", "neither"); // counted from the image's middle
  readCamera.fails("K: " + matrix + "\nRadialDistortion: [0, 0]\nImageSize: [480, 640]", "MATLAB");
  EXPECT_EQ(readCamera(R"({"intrinsics": [{"fx": 800, "fy": 801, "cx": 320, "cy": 240}]})").camera.fy, 801.0);
  EXPECT_EQ(readCamera("fx: 800\nfy: 801\ncx: 320\ncy: 240\nfocal_length: 4.8 mm").camera.fx, 800.0);
}

namespace
{
/// A camera of 640 x 480 pixels, in YAML, with these lines.
std::string yamlWith(const std::string& lines)
{
  return "width: 640\nheight: 480\nfx: 800\nfy: 801\ncx: 320\ncy: 240\n" + lines + "\n";
}
}

TEST(CameraFile, distortionByAnyName)
{
  const std::array<double, 8> numbers{ -0.3, 0.1, 0.001, -0.002, 0.01 };
  const std::string list = ": [-0.3, 0.1, 0.001, -0.002, 0.01]";
  for (const std::string name :
    { "distortion_coefficients", "dist_coeffs", "distCoeffs", "Distortion_Coefficients", "dist", "distortion", "D1",
      "distorsion", "lens_distortion", "cam_dist", "coeffs", "coeff", "distortion_model: plumb_bob\ndist_coeff" })
  {
    EXPECT_EQ(readCamera(yamlWith(name + list)).camera.distortion, numbers) << name;
  }
  EXPECT_EQ(readCamera(replaced(replaced(xml, "<dist_coeffs", "<DistCoeffs"), "</dist_coeffs", "</DistCoeffs"))
              .camera.distortion[3],
    0.4);
  const std::string named = "k1: -0.3\nk2: 0.1\np1: 0.001\np2: -0.002\nk3: 0.01";
  EXPECT_EQ(readCamera(yamlWith(named)).camera.distortion, numbers);
  EXPECT_EQ(readCamera(yamlWith("distortion: {K1: -0.3, K2: 0.1, P1: 0.001, P2: -0.002, K3: 0.01}")).camera.distortion,
    numbers);
  EXPECT_EQ(readCamera(yamlWith(named + "\nk4: 1\nk5: 2\nk6: 3")).camera.distortion[7], 3.0);
  EXPECT_EQ(readCamera(yamlWith("k1: 0\nk2: 0")).camera.distortion, (std::array<double, 8>{}));
  EXPECT_EQ(
    readCamera("intrinsics: {fx: 800, fy: 801, cx: 320, cy: 240}\ndistortion" + list).camera.distortion, numbers)
    << "beside the camera's own entries";
  EXPECT_EQ(readCamera(yamlWith("distance: 700\nros_distro: humble\nis_undistorted: no")).camera.distortion,
    (std::array<double, 8>{}));
  readCamera.fails(yamlWith("k1: 0.1\nk2: 0.1\nk3: 0.1\nk4: 0.1"), "names coefficients of its lens");
  readCamera.fails(yamlWith(named + "\nk4: 1"), "names coefficients of its lens");
  readCamera.fails(yamlWith(named + "\ns1: 1"), "thin prism");
  readCamera.fails(yamlWith("distortion: {radial: [0.1, 0.2]}"), "a distortion that is not made of numbers");
  readCamera.fails(yamlWith("dist: [0, 0, 0, 0]\nD" + list), "other coefficients as dist than as D");
}

TEST(CameraFile, otherLenses)
{
  const std::string fisheye =
    replaced(yaml, "image_width", "fisheye_model: 1\nimage_width"); // whatever its coefficients are
  readCamera.fails(fisheye, "a lens of the model 'fisheye', which is not read");
  EXPECT_EQ(readCamera(replaced(fisheye, "_model: 1", "_model: 0")).camera.width, 1280);
  readCamera.fails(replaced(xml, "<depth_scale>", "<fisheye_model>1</fisheye_model><depth_scale>"), "'fisheye'");
  readCamera.fails(
    replaced(xml, "<depth_scale>", "<distortion_model>equidistant</distortion_model><depth_scale>"), "'equidistant'");
  const std::string numbered = yamlWith("model: 2\ncoeffs: [0.1, 0, 0, 0, 0]"); // RealSense's
  readCamera.fails(numbered, "'inversebrownconrady'");
  EXPECT_EQ(readCamera(replaced(numbered, "model: 2", "model: 4")).camera.distortion[0], 0.1);
  const std::string kalibr = "cam0:\n  camera_model: omni\n  distortion_coeffs: []\n  distortion_model: none\n  "
                             "intrinsics: [1.2, 800, 801, 320, 240]\n  resolution: [640, 480]\n";
  readCamera.fails(kalibr, "'omni'");
  readCamera.fails(replaced(kalibr, "omni", "eucm"), "'eucm'");
}

TEST(CameraFile, namesInAnySpelling)
{
  const std::string matrix = ": [[800, 0, 320], [0, 801, 240], [0, 0, 1]]\n";
  for (const std::string name : { "K", "k", "cam_K", "mtx", "M1", "cameraMatrix", "Camera_Matrix" })
  {
    EXPECT_EQ(readCamera(name + matrix).camera.fy, 801.0) << name;
  }
  readCamera.fails("M1" + matrix + "M2" + matrix, "has 2 cameras");
  EXPECT_EQ(readCamera("fx: \"800\"\nfy: '801'\ncx: \"320\"\ncy: \"240.5\"\n").camera.cy, 240.5);
}

TEST(CameraFile, partsOfAnImage)
{
  const std::string text = yamlWith("binning_x: 1\nbinning_y: 0\nroi: {x_offset: 0, y_offset: 0, width: 640}");
  EXPECT_EQ(readCamera(text).camera.width, 640);
  readCamera.fails(replaced(text, "binning_y: 0", "binning_y: 2"), "has a binning or a region of interest");
  readCamera.fails(replaced(text, "y_offset: 0", "y_offset: 100"), "has a binning or a region of interest");
}

TEST(CameraFile, whatIsNoCalibration)
{
  EXPECT_THROW(meam::readCamera("/no/such/camera.json"), meam::Error);
  EXPECT_THROW(meam::readCamera(testing::TempDir()), meam::Error);
  readCamera.fails("", "empty");
  readCamera.fails("nothing of the kind", "neither");
  readCamera.fails("{}", "neither");
  readCamera.fails("{ \"fx\": 1, ", "not JSON");
  readCamera.fails(yaml.substr(0, 150), "a camera_matrix that is not made of numbers");
  readCamera.fails(yaml.substr(0, yaml.find("511.5")), "not YAML in line 10");
  readCamera.fails(xml.substr(0, 200), "cut off");
  readCamera.fails(xml.substr(0, xml.find("</opencv")), "no end of <opencv_storage>");
  readCamera.fails(replaced(xml, "</dist_coeffs>", "</lens>"), "wrong place");
  readCamera.fails(replaced(bop, "\"fy\"", "\"fz\""), "neither");
  readCamera.fails(replaced(bop, "573.57", "-1"), "focal lengths");
  readCamera.fails(replaced(bop, "573.57", "\"wide\""), "a fy that is not made of numbers");
  readCamera.fails(replaced(bop, "640", "640.5"), "width or height");
  readCamera.fails(replaced(bop, "640", "4000000000"), "width or height");
  readCamera.fails(replaced(bop, "0.1", "0"), "depth_scale");
  readCamera.fails(replaced(bop, "0.1", "1e999"), "too large");
  readCamera.fails(replaced(json, "800.0, ", ""), "camera_matrix");
  readCamera.fails(replaced(json, "800.0", "\"a\""), "camera_matrix");
  readCamera.fails(replaced(json, "800.0, 0.0", "800.0, 3.0"), "camera matrix that is not");
  readCamera.fails(replaced(json, "0, 0, 0, 0, 0, 0, 0, 0", "0, 1, 0"), "3 numbers of its lens");
  readCamera.fails(replaced(json, "0, 0, 0, 0, 0, 0, 0, 0", "0, 0, 0, 0, 0, 0, 0, 0, 1"), "thin prism");
  readCamera.fails(replaced(json, "[1, 0, 0, 5]", "[2, 0, 0, 5]"), "not a rotation");
  readCamera.fails(replaced(yaml, "T: [ 400, 0, -100 ]\n", ""), "only one of R and T");
  readCamera.fails(replaced(yaml, "400, 0, -100", "400, 0, .Nan"), "a T that is not made of numbers");
  readCamera.fails(replaced(yaml, "400, 0, -100", "400, 0, x"), "a T that is not made of numbers");
  readCamera.fails(std::string(2 << 20, ' ') + bop, "not a text");
}

// Each of them was once searched for a colon to the end of the file: minutes, which the test's time limit ends.
TEST(CameraFile, readsManyLinesWithoutAName) { readCamera.fails(std::string(1000000, '\n') + "a", "neither"); }
