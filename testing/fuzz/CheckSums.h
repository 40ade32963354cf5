// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace fuzz
{
/// Gives a trained model's file its right check sum again.
std::string withModelCheckSum(std::string bytes);

/// Gives every chunk of a PNG file its right check sum again, as far as chunks can be told apart.
std::string withPNGCheckSums(std::string bytes);
}
