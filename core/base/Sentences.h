// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace meam
{
/// Adds a sentence to a text of some, with a blank between them; either may be empty.
inline void appendSentence(std::string& text, const std::string& sentence)
{
  text += (text.empty() || sentence.empty() ? "" : " ") + sentence;
}
}
