// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "TestImages.h"
#include "io/ImageFile.h"

namespace
{
const files::Reader readImage{ meam::readImage };

const cv::Mat grey = (cv::Mat_<std::uint8_t>(2, 3) << 0, 50, 100, 150, 200, 255);
}

TEST(ImageFile, greyImages)
{
  for (const char* form : { ".png", ".bmp", ".tiff" })
  {
    const files::Folder folder;
    const std::string path = folder.write("image", images::encoded(form, grey));
    const meam::Image image = meam::readImage(path);
    EXPECT_EQ(image.width, 3) << form;
    EXPECT_EQ(image.height, 2) << form;
    EXPECT_EQ(image.channels, 1) << form;
    EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{ 0, 50, 100, 150, 200, 255 })) << form;
    EXPECT_EQ(meam::readImageSize(path), (std::array<int, 2>{ 3, 2 })) << form;
  }
}

TEST(ImageFile, coloursAreRedGreenBlue)
{
  const cv::Mat colour(16, 24, CV_8UC3, cv::Scalar(10, 20, 200));
  for (const char* form : { ".png", ".bmp", ".tiff", ".jpg" })
  {
    const meam::Image image = readImage(images::encoded(form, colour));
    ASSERT_EQ(image.channels, 3) << form;
    EXPECT_EQ(image.width, 24) << form;
    ASSERT_EQ(image.pixels.size(), 3u * 16 * 24) << form;
    EXPECT_NEAR(image.pixels[0], 200, 2) << form;
    EXPECT_NEAR(image.pixels[1], 20, 2) << form;
    EXPECT_NEAR(image.pixels[2], 10, 2) << form;
  }
  const cv::Mat seen = cv::Mat(1, 1, CV_8UC4, cv::Scalar(1, 2, 3, 0));
  EXPECT_EQ(readImage(images::encoded(".png", seen)).pixels, (std::vector<std::uint8_t>{ 3, 2, 1 }))
    << "alpha is dropped";
}

// Of a large image each scan takes milliseconds, and ten bytes of the file.
TEST(ImageFile, aJPEGOfMoreScansThanCanBeIsRefused)
{
  const files::Folder folder;
  std::vector<unsigned char> progressive;
  cv::imencode(
    ".jpg", cv::Mat(16, 24, CV_8UC3, cv::Scalar(10, 100, 200)), progressive, { cv::IMWRITE_JPEG_PROGRESSIVE, 1 });
  std::string bytes(progressive.begin(), progressive.end());
  EXPECT_EQ(meam::readImage(folder.write("image.jpg", bytes)).channels, 3);
  for (int scan = 0; scan < 600; ++scan)
  {
    bytes.insert(bytes.size() - 2, "\xff\xda\x00\x08\x01\x01\x00\x01\x3f\x10", 10); // again the first component's waves
  }
  const std::string path = folder.write("image.jpg", bytes);
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::readImage(path); }), "more than 500 times"));
}

TEST(ImageFile, theSizeOfAJPEGIsThatOfTheFrameThatIsDecoded)
{
  // Behind a marker without a length, and far behind it another frame.
  std::string bytes = images::encoded(".jpg", cv::Mat(16, 24, CV_8UC1, cv::Scalar(100)));
  bytes.insert(2, "\xff\x01");
  bytes.resize(4 + 0xffe0, ' ');
  bytes += std::string("\xff\xc0\x00\x11\x08\x00\x01\x00\x01\x01", 10) + std::string(20, ' ');
  const files::Folder folder;
  EXPECT_EQ(meam::readImageSize(folder.write("image.jpg", bytes)), (std::array<int, 2>{ 24, 16 }));
  EXPECT_EQ(readImage(bytes).pixels.size(), 16u * 24u);
}

TEST(ImageFile, theSizeMayStandFarBehindTheStart)
{
  cv::Mat noise(300, 400, CV_8UC1);
  cv::randu(noise, 0, 256);
  const files::Folder folder;
  for (const char* form : { ".png", ".bmp", ".tiff", ".jpg" })
  {
    std::string bytes = images::encoded(form, noise);
    if (form == std::string(".jpg"))
    {
      bytes.insert(2, "\xff\xe1\xff\xff" + std::string(0xfffd, ' ')); // a preview
    }
    EXPECT_EQ(meam::readImageSize(folder.write("image", bytes)), (std::array<int, 2>{ 400, 300 })) << form;
  }
}

TEST(ImageFile, sixteenBitsUseTheirWholeRange)
{
  const cv::Mat deep = (cv::Mat_<std::uint16_t>(1, 3) << 0, 257 * 40, 65535);
  EXPECT_EQ(readImage(images::encoded(".png", deep)).pixels, (std::vector<std::uint8_t>{ 0, 40, 255 }));
  const auto valuesOf = [](int a, int b)
  { return readImage(images::encoded(".png", (cv::Mat_<std::uint16_t>(1, 2) << a, b))).pixels; };
  EXPECT_EQ(valuesOf(1, 9), (std::vector<std::uint8_t>{ 1, 9 })) << "labels";
  EXPECT_EQ(valuesOf(4095, 819), (std::vector<std::uint8_t>{ 255, 51 })) << "a camera of 12 bits";
  const files::Folder folder;
  const std::vector<float> depths = meam::readDepthPixels(folder.write("deep", images::encoded(".png", deep))).pixels;
  EXPECT_EQ(depths[1], 257 * 40);
  EXPECT_TRUE(std::isnan(depths[0]) && std::isnan(depths[2]));
}

TEST(ImageFile, badFiles)
{
  EXPECT_THROW(meam::readImage("/no/such/image.png"), meam::Error);
  readImage.fails("", "not a PNG");
  readImage.fails("GIF89a", "not a PNG");
  readImage.fails(images::encoded(".png", cv::Mat::zeros(4, 4, CV_32FC1)).substr(0, 20), "no size");
  for (const char* form : { ".png", ".jpg", ".tiff", ".bmp" })
  {
    const std::string bytes = images::encoded(form, cv::Mat::zeros(40, 40, CV_8UC1));
    readImage.fails(bytes.substr(0, 12), "no size");
  }
  const std::string png = images::encoded(".png", grey);
  readImage.fails(png.substr(0, png.size() / 2), "damaged");
  std::string flipped = png;
  flipped[45] ^= 1;
  readImage.fails(flipped, "damaged");
}

TEST(ImageFile, filesThatAreCutOffSayNothingOnTheConsole)
{
  for (const char* form : { ".png", ".bmp" })
  {
    const std::string whole = images::encoded(form, cv::Mat(16, 24, CV_8UC3, cv::Scalar(10, 20, 200)));
    for (const std::size_t length : { whole.size() / 2, whole.size() - 1 })
    {
      testing::internal::CaptureStderr();
      readImage.fails(whole.substr(0, length), "cut off");
      EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << form << " of " << length << " bytes";
    }
  }
}

TEST(ImageFile, absurdSizesAreRefusedBeforeMemoryIsTaken)
{
  const auto with = [](std::string bytes, std::size_t at, const std::string& value)
  { return bytes.replace(at, value.size(), value); };
  const std::string most = "\x7f\xff\xff\xff";
  readImage.fails(with(images::encoded(".png", grey), 16, most + most), "more than the file has room for");
  readImage.fails(with(images::encoded(".bmp", grey), 18, "\xff\xff\xff\x7f\xff\xff\xff\xff"), "more than the file");
  readImage.fails(with(images::encoded(".png", grey), 16, std::string("\0\0\x40\0\0\0\x40\0", 8)), "16384 x 16384");
}

TEST(ImageFile, ofATIFFOnlyTagsThatTakeNoUndueMemoryAreRead)
{
  const std::string file = images::encoded(".tiff", grey);
  const auto tag = [](int name, int type, const std::string& value)
  {
    return std::string{ static_cast<char>(name), static_cast<char>(name >> 8), static_cast<char>(type), 0, 1, 0, 0,
      0 } + value;
  };
  /// The file with another tag in place of one that is there.
  const auto with = [&](int name, const std::string& other)
  {
    const std::size_t at = file.find(tag(name, 3, ""));
    EXPECT_NE(at, std::string::npos) << name;
    return std::string(file).replace(at, other.size(), other);
  };
  constexpr int bits = 258, compression = 259, samples = 277, rowsOfStrip = 278, tileWidth = 322;
  // One strip that is higher than the image, as some programs write it.
  for (const std::string& rows : { tag(rowsOfStrip, 3, std::string("\xff\xff\0\0", 4)),
         tag(rowsOfStrip, 4, "\xff\xff\xff\xff"), tag(rowsOfStrip, 4, "\xff\xff\xff\x7f") })
  {
    EXPECT_EQ(readImage(with(rowsOfStrip, rows)).pixels, readImage(file).pixels);
  }
  readImage.fails(with(compression, tag(compression, 3, std::string("\x65\x87\0\0", 4))), "is not read (34661)");
  readImage.fails(with(bits, tag(bits, 3, std::string("\x40\0\0\0", 4))), "8 or 16 bits");
  readImage.fails(with(samples, tag(samples, 3, std::string("\x05\0\0\0", 4))), "8 or 16 bits");
  readImage.fails(
    with(bits, tag(bits, 16, std::string("\x08\0\0\0", 4))), "8 or 16 bits"); // libtiff reads it elsewhere
  readImage.fails(with(rowsOfStrip, tag(rowsOfStrip, 1, std::string("\x02\0\0\0", 4))), "strips or tiles");
  readImage.fails(with(rowsOfStrip, tag(tileWidth, 4, std::string("\0\0\x10\0", 4))), "strips or tiles");
}
