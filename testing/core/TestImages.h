// SPDX-License-Identifier: BSD-3-Clause
// Image files made by OpenCV.
#pragma once

#include <opencv2/imgcodecs.hpp>

#include <string>
#include <vector>

namespace images
{
/// The bytes of an image file; `form` is an extension such as ".png".
inline std::string encoded(const std::string& form, const cv::Mat& pixels)
{
  std::vector<unsigned char> bytes;
  cv::imencode(form, pixels, bytes);
  return std::string(bytes.begin(), bytes.end());
}
}
