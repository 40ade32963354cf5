// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/OrganizedCloud.h"

#include <array>
#include <string>

namespace meam
{
/// Width and height of a PNG, JPEG, BMP, TIFF, PGM or PFM image, as its header promises them. Throws Error, naming the
/// file, for another kind of file and for a size that its bytes cannot hold.
std::array<int, 2> readImageSize(const std::string& path);

/// Reads a grey or colour image: PNG, JPEG, BMP or TIFF. An alpha channel is dropped; 16 bit images use their
/// whole range. Throws Error, naming the file and what is wrong with it; allocates no more than its length
/// justifies.
Image readImage(const std::string& path);

/// Throws Error, naming the image's file, unless it has a pixel for each point of the cloud.
void requireRegistered(const Image& image, const OrganizedCloud& cloud, const std::string& path);

/// The values of an image of one channel, row by row.
struct DepthPixels
{
  int width = 0;
  int height = 0;
  std::vector<float> pixels; ///< NaN where there is no depth: 0 and less, the largest value of 8 or 16 bits, NaN
};

/// Reads an image of one channel, as depth images are: whole numbers of 16 bits (PNG, TIFF, PGM), of 8 (PGM) or of 32
/// (TIFF), or real ones of 32 (TIFF, PFM) or 64 (TIFF). Throws Error as readImage().
DepthPixels readDepthPixels(const std::string& path);
}
