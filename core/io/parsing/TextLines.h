// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

namespace meam
{
/// The text behind a byte order mark.
inline std::string_view withoutMark(std::string_view text)
{
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.substr(text.substr(0, mark.size()) == mark ? mark.size() : 0);
}

/// The text without what programs put about it: a byte order mark and blanks before, blanks and Ctrl-Z behind.
inline std::string_view bareText(std::string_view text)
{
  text = withoutMark(text);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text.substr(0, text.find_last_not_of(" \t\r\n\x1a") + 1);
}

/// Goes through the words of a text line by line; comments, from # on, and empty lines are skipped.
class TextLines
{
public:
  explicit TextLines(std::string_view bytes)
    : Rest(withoutMark(bytes.substr(0, bytes.find_last_not_of('\x1a') + 1)))
  {
  }

  /// Goes to the next line that has a word; false at the end of the file.
  bool next()
  {
    while (!this->Rest.empty())
    {
      const std::size_t end = std::min(this->Rest.find_first_of("\r\n"), this->Rest.size());
      this->Line = this->Rest.substr(0, end);
      this->Rest.remove_prefix(std::min(end + 1, this->Rest.size()));
      this->Line = this->Line.substr(0, this->commentAt());
      if (this->Line.find_first_not_of(" \t") != std::string_view::npos)
      {
        return true;
      }
    }
    this->Line = {};
    return false;
  }

  /// What is left of the line.
  std::string_view line() const { return this->Line; }

  /// The next word of the line; empty at its end.
  std::string_view word()
  {
    this->Line.remove_prefix(std::min(this->Line.find_first_not_of(" \t"), this->Line.size()));
    const std::size_t end = std::min(this->Line.find_first_of(" \t"), this->Line.size());
    const std::string_view result = this->Line.substr(0, end);
    this->Line.remove_prefix(end);
    return result;
  }

  /// Bytes of the line and of all after it.
  std::size_t left() const { return this->Line.size() + 1 + this->Rest.size(); }

private:
  /// Where a comment begins; 1.#QNAN is a number of Windows.
  std::size_t commentAt() const
  {
    std::size_t at = this->Line.find('#');
    while (at != std::string_view::npos && at > 0 && this->Line[at - 1] == '.')
    {
      at = this->Line.find('#', at + 1);
    }
    return at;
  }

  std::string_view Rest;
  std::string_view Line;
};

/// Whether a word is 1.#QNAN, -1.#IND or 1.#INF, as programs of Windows write what is no number.
inline bool isNaNOfWindows(std::string_view word) { return word.find(".#") != std::string_view::npos; }

/// The number that a word is, whatever the locale.
template <typename Number>
bool parseNumber(std::string_view text, Number& value)
{
  if (text.size() > 1 && text[0] == '+')
  {
    text.remove_prefix(1);
  }
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  return failure == std::errc() && end == text.data() + text.size();
}
}
