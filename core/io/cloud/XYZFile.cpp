// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud/XYZFile.h"

#include "io/parsing/FileBytes.h"
#include "io/parsing/TextLines.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace meam
{
namespace
{
constexpr std::size_t MostWithoutNames = 10; // x y z, an intensity, a colour and a normal
constexpr std::size_t LeastNumbered = 20;    // lines: of fewer points x may count, too
constexpr std::int64_t Beginning = 1 << 16;  // bytes that isXYZ() looks at
constexpr std::size_t MostHeads = 8;         // lines before the points that may name the columns
constexpr char Separators[] = { ';', '\t', ',', ' ' };
constexpr float NotMeasured = std::numeric_limits<float>::quiet_NaN();

[[noreturn]] void failXYZ(const std::string& path, const std::string& what)
{
  throw Error("The text of points '" + path + "' " + what + ".");
}

std::string quoted(std::string_view text) { return "'" + std::string(text.substr(0, 40)) + "'"; }

/// The text without blanks and quotes about it.
std::string_view trimmed(std::string_view text)
{
  const std::size_t start = text.find_first_not_of(" \t\"'");
  return start == std::string_view::npos ? std::string_view()
                                         : text.substr(start, text.find_last_not_of(" \t\"'") + 1 - start);
}

/// The words of a line between separators, of which blanks and tabs are one kind.
void split(std::string_view line, char separator, std::vector<std::string_view>& words)
{
  const std::string_view separators = separator == ' ' ? std::string_view(" \t") : std::string_view(&separator, 1);
  words.clear();
  line = separator == ' ' ? line.substr(0, line.find_last_not_of(separators) + 1) : line;
  std::size_t end = 0;
  do
  {
    line.remove_prefix(separator == ' ' ? std::min(line.find_first_not_of(separators), line.size()) : 0);
    end = line.find_first_of(separators);
    words.push_back(trimmed(line.substr(0, end)));
    line.remove_prefix(end == std::string_view::npos ? line.size() : end + 1);
  } while (end != std::string_view::npos);
}

/// The number that a word is, not measured where it says so; false when it is a word of another kind.
bool numberOf(std::string_view word, char separator, float& value)
{
  value = NotMeasured;
  if (word.empty() || word == "-" || word == "null" || word == "None" || isNaNOfWindows(word))
  {
    return true;
  }
  double number = 0.0;
  const std::size_t comma = word.find(',');
  if (separator == ',' || comma == std::string_view::npos)
  {
    if (!parseNumber(word, number))
    {
      return false;
    }
  }
  else
  {
    std::string withPoint(word);
    withPoint[comma] = '.';
    if (!parseNumber(std::string_view(withPoint), number))
    {
      return false;
    }
  }
  value = static_cast<float>(number);
  return true;
}

/// Whether a zero stands before a number, as behind a decimal comma that is taken for a separator.
bool isPadded(std::string_view word)
{
  word.remove_prefix(word.substr(0, 1) == "-" ? 1 : 0);
  return word.size() > 1 && word[0] == '0' && std::isdigit(static_cast<unsigned char>(word[1]));
}

/// How many letters begin a comment in a line: two of //, one of # or %, 0 of none.
std::size_t lettersOfComment(std::string_view line)
{
  line = trimmed(line);
  return line.substr(0, 2) == "//" ? 2 : line.substr(0, 1) == "#" || line.substr(0, 1) == "%" ? 1 : 0;
}

/// What stands between the numbers of a line: a semicolon, a tab, a comma or blanks; 0 when it is no line of a point.
char separatorOf(std::string_view line, std::vector<std::string_view>& words)
{
  for (const char separator : Separators)
  {
    split(line, separator, words);
    float value;
    if (words.size() >= 3 && std::all_of(words.begin(), words.end(),
                               [&](std::string_view word) { return numberOf(word, separator, value); }))
    {
      return separator;
    }
  }
  return 0;
}

/// The columns that hold something, -1 where none does.
struct Columns
{
  std::array<int, 3> point{ 0, 1, 2 }, normal{ -1, -1, -1 }, color{ -1, -1, -1 };
  int intensity = -1;

  std::array<int, 10> all() const
  {
    return { point[0], point[1], point[2], normal[0], normal[1], normal[2], color[0], color[1], color[2], intensity };
  }
  bool has(std::size_t column) const
  {
    const std::array<int, 10> all = this->all();
    return std::find(all.begin(), all.end(), static_cast<int>(column)) != all.end();
  }
  int last() const
  {
    const std::array<int, 10> all = this->all();
    return *std::max_element(all.begin(), all.end());
  }
};

bool isWhole(const std::array<int, 3>& columns)
{
  return std::all_of(columns.begin(), columns.end(), [](int column) { return column >= 0; });
}

/// Whether a line names columns by their numbers, behind one of a row's number without a name: 0, 1, 2, as tables of
/// Python's pandas.
bool isNumbered(const std::vector<std::string_view>& words)
{
  bool isSo = words.size() > 3 && words[0].empty();
  for (std::size_t i = 1; isSo && i < words.size(); ++i)
  {
    isSo = words[i] == std::to_string(i - 1);
  }
  return isSo;
}

/// The columns by their names.
Columns columnsOf(const std::vector<std::string_view>& words)
{
  Columns columns;
  if (isNumbered(words))
  {
    columns.point = { 1, 2, 3 };
    return columns;
  }
  columns.point.fill(-1);
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    std::string name(words[i].substr(0, words[i].find_first_of("([")));
    name.erase(name.find_last_not_of(' ') + 1);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char letter) { return std::tolower(letter); });
    const auto isOne = [&](std::initializer_list<std::string> names)
    { return std::find(names.begin(), names.end(), name) != names.end(); };
    const auto take = [&](int& column) { column = column < 0 ? static_cast<int>(i) : column; };
    for (int k = 0; k < 3; ++k)
    {
      const std::string axis(1, "xyz"[k]), number(1, "012"[k]), letter(1, "rgb"[k]);
      if (isOne({ axis, "points:" + number, "points_" + number, "points_" + axis, "pos_" + axis, "position_" + axis }))
      {
        take(columns.point[k]);
      }
      else if (isOne({ "n" + axis, "normal_" + axis, "normals:" + number, "normals_" + number, "normals_" + axis }))
      {
        take(columns.normal[k]);
      }
      else if (isOne({ letter, std::array{ "red", "green", "blue" }[k], "rgb:" + number, "rgb_" + number }))
      {
        take(columns.color[k]);
      }
    }
    if (isOne({ "intensity", "gray", "grey", "i", "scalar_intensity" }))
    {
      take(columns.intensity);
    }
  }
  return columns;
}

/// The points of a text, line by line.
class Table
{
public:
  Table(const std::string& path, std::string_view text)
    : Path(path)
    , Rest(withoutMark(text.substr(0, text.find_last_not_of('\x1a') + 1)))
  {
  }

  /// Goes to the first point. Throws Error when there is none, or a line before it that is neither a comment nor names.
  void start()
  {
    if (this->Rest.find('\0') != std::string_view::npos)
    {
      failXYZ(this->Path, "is not a text: it is binary, or packed");
    }
    std::vector<std::string_view> heads;
    std::string_view other;
    while (this->next())
    {
      if (const std::size_t letters = lettersOfComment(this->Line); letters > 0)
      {
        heads.push_back(trimmed(this->Line).substr(letters));
      }
      else
      {
        split(this->Line, ',', this->Words);
        if (isNumbered(this->Words))
        {
          heads.push_back(this->Line);
          continue;
        }
        this->Started = this->isNamed(heads) || this->isUnnamed(other);
        std::uint64_t count = 0;
        if (this->Started)
        {
          return;
        }
        if (parseNumber(trimmed(this->Line), count))
        {
          this->Promised = count;
        }
        else if (!other.empty() || std::isdigit(static_cast<unsigned char>(trimmed(this->Line)[0])))
        {
          this->fail("has " + quoted(this->Line) + " where a point's x, y and z are expected");
        }
        else
        {
          other = this->Line;
          heads.push_back(this->Line);
        }
      }
      if (heads.size() > MostHeads)
      {
        heads.erase(heads.begin());
      }
    }
    failXYZ(this->Path,
      other.empty() ? "has no line with the numbers x, y and z of a point" : "has no point after " + quoted(other));
  }

  /// Takes the point of this line. Throws Error for a line that is no point.
  void take(std::vector<float>& values)
  {
    split(this->Line, this->Separator, this->Words);
    const std::size_t count = this->Words.size();
    if (count < this->Width || (!this->HasNames && count > this->Width && !this->Words[this->Width].empty()))
    {
      this->fail("has " + std::to_string(count) + " words, where the first point has " + std::to_string(this->Width) +
                 ": it is cut off or damaged");
    }
    for (std::size_t i = 0; i < this->Width; ++i)
    {
      if (this->Separator == ',' && isPadded(this->Words[i]))
      {
        this->fail("has " + quoted(this->Words[i]) +
                   " as a number: where numbers have decimal commas, separate them by semicolons, tabs or blanks");
      }
      float value = NotMeasured;
      if ((!this->HasNames || this->Named.has(i)) && !numberOf(this->Words[i], this->Separator, value))
      {
        this->fail("has " + quoted(this->Words[i]) + " where a number is expected");
      }
      values.push_back(value);
    }
  }

  /// Goes to the next line with a word, or between tabs without, and beyond the first point to one that is no comment;
  /// false at the end.
  bool next()
  {
    while (!this->Rest.empty())
    {
      const std::size_t end = std::min(this->Rest.find_first_of("\r\n"), this->Rest.size());
      this->Line = this->Rest.substr(0, end);
      this->Rest.remove_prefix(std::min(end + (this->Rest.substr(end, 2) == "\r\n" ? 2 : 1), this->Rest.size()));
      ++this->Number;
      const bool isEmpty = trimmed(this->Line).empty() && !(this->Separator == '\t' && !this->Line.empty());
      if (!isEmpty && !(this->Started && lettersOfComment(this->Line) > 0))
      {
        return true;
      }
    }
    return false;
  }

  std::size_t left() const { return this->Rest.size(); }
  std::size_t width() const { return this->Width; } ///< numbers of a point
  std::uint64_t promised() const { return this->Promised; }
  bool hasNames() const { return this->HasNames; }
  const Columns& columns() const { return this->Named; }

private:
  [[noreturn]] void fail(const std::string& what) const
  {
    failXYZ(this->Path, "in line " + std::to_string(this->Number) + " " + what);
  }

  /// Whether a line before this one names columns that are numbers in this one.
  bool isNamed(const std::vector<std::string_view>& heads)
  {
    for (const std::string_view head : heads)
    {
      for (const char ofHead : Separators)
      {
        split(head, ofHead, this->Words);
        this->Named = columnsOf(this->Words);
        if (!isWhole(this->Named.point))
        {
          continue;
        }
        for (const char separator : Separators)
        {
          split(this->Line, separator, this->Words);
          float value;
          std::size_t i = 0;
          while (i < this->Words.size() && (!this->Named.has(i) || numberOf(this->Words[i], separator, value)))
          {
            ++i;
          }
          if (i == this->Words.size() && this->Named.last() < static_cast<int>(i))
          {
            this->HasNames = true;
            this->Separator = separator;
            this->Width = i;
            return true;
          }
        }
      }
    }
    return false;
  }

  /// Whether this line is the first point of a text that does not name its columns. Throws Error for the names of
  /// others, and for too many numbers.
  bool isUnnamed(std::string_view other)
  {
    this->Separator = separatorOf(this->Line, this->Words);
    this->Width = this->Words.size();
    if (this->Separator != 0 && !other.empty())
    {
      failXYZ(this->Path, "names its columns " + quoted(other) + ": name x, y and z among them");
    }
    if (this->Separator != 0 && this->Width > MostWithoutNames)
    {
      this->fail("has " + std::to_string(this->Width) +
                 " numbers: name the columns in a first line, x y z among them; an image of depths is read from PNG, "
                 "TIFF, PGM or PFM");
    }
    return this->Separator != 0;
  }

  const std::string& Path;
  std::string_view Rest, Line;
  std::vector<std::string_view> Words;
  std::size_t Width = 0;
  std::uint64_t Promised = 0;
  std::size_t Number = 0;
  char Separator = 0;
  bool HasNames = false, Started = false;
  Columns Named;
};

/// Tells by their values what three columns are.
class Guess
{
public:
  /// `isPTS`: with the number of points on top, as texts of laser scanners, whose intensity comes before the colour.
  Guess(const std::vector<float>& values, std::size_t width, bool isPTS)
    : Values(values)
    , IsPTS(isPTS)
    , Width(width)
    , Used(width)
  {
    while (this->Used > 3 && this->isEmpty(this->Used - 1)) // lines that end with a separator
    {
      --this->Used;
    }
  }

  /// The columns of points without names: after x y z an intensity, where one stands alone, colours and normals. Before
  /// them the line's number may stand, or its row and column.
  Columns columns() const
  {
    const std::size_t point = this->isNumber() ? 1 : this->isRowAndColumn() ? 2 : 0;
    const int x = static_cast<int>(point);
    Columns columns;
    columns.point = { x, x + 1, x + 2 };
    std::size_t first = point + 3;
    if ((this->Used - point) % 3 == 1)
    {
      const bool isFirst = this->Used == first + 1 || ((this->isColor(first + 1) || this->isNormal(first + 1)) &&
                                                        (this->IsPTS || !this->isColor(first)));
      columns.intensity = isFirst ? x + 3 : static_cast<int>(this->Used) - 1;
      first += isFirst ? 1 : 0;
    }
    for (std::size_t k = first; k + 3 <= this->Used; k += 3)
    {
      const int column = static_cast<int>(k);
      if (this->isNormal(k) && columns.normal[0] < 0)
      {
        columns.normal = { column, column + 1, column + 2 };
      }
      else if (this->isColor(k) && columns.color[0] < 0)
      {
        columns.color = { column, column + 1, column + 2 };
      }
    }
    return columns;
  }

private:
  /// Whether the first of four columns and more counts the lines.
  bool isNumber() const
  {
    bool isSo = this->Used > 3 && this->Values.size() >= LeastNumbered * this->Width;
    for (std::size_t i = this->Width; isSo && i < this->Values.size(); i += this->Width)
    {
      isSo = this->Values[i] == this->Values[0] + static_cast<float>(i / this->Width);
    }
    return isSo;
  }
  /// Whether the first two of five columns, or eight, are places of an image, line after line: as whole numbers x and y
  /// of points may be, too, but two more columns are none of z, an intensity and a colour.
  bool isRowAndColumn() const
  {
    bool isByRows = this->Used % 3 == 2 && this->Values.size() >= LeastNumbered * this->Width, isByColumns = isByRows;
    for (std::size_t i = 0; (isByRows || isByColumns) && i < this->Values.size(); i += this->Width)
    {
      const float* at = this->Values.data() + i;
      const float* before = at - (i == 0 ? 0 : this->Width);
      const bool isPlace = at[0] == std::floor(at[0]) && at[1] == std::floor(at[1]) && at[0] >= 0.0f && at[1] >= 0.0f;
      const auto follows = [&](int slow, int fast) {
        return isPlace && (i == 0 || at[slow] > before[slow] || (at[slow] == before[slow] && at[fast] > before[fast]));
      };
      isByRows = isByRows && follows(0, 1);
      isByColumns = isByColumns && follows(1, 0);
    }
    return isByRows || isByColumns;
  }
  /// Whether three columns from `first` on are unit vectors, as far as they were measured.
  bool isNormal(std::size_t first) const
  {
    constexpr float tolerance = 0.01f; // of numbers with three digits
    return this->all(first,
      [](const float* value)
      {
        const float length = std::hypot(value[0], value[1], value[2]);
        return !(std::abs(length - 1.0f) > tolerance);
      });
  }
  /// Whether three columns are whole numbers of 8 or 16 bits, or from 0 to 1.
  bool isColor(std::size_t first) const
  {
    const auto isWithin = [&](float most, bool mustBeWhole)
    {
      return this->all(first,
        [=](const float* value)
        {
          return std::none_of(
            value, value + 3, [=](float v) { return v < 0.0f || v > most || (mustBeWhole && v != std::floor(v)); });
        });
    };
    return isWithin(65535.0f, true) || isWithin(1.0f, false);
  }
  template <typename Test>
  bool all(std::size_t first, const Test& test) const
  {
    for (std::size_t i = first; i + 3 <= this->Values.size(); i += this->Width)
    {
      const float* value = this->Values.data() + i;
      if (std::all_of(value, value + 3, [](float v) { return std::isfinite(v); }) && !test(value))
      {
        return false;
      }
    }
    return true;
  }

  bool isEmpty(std::size_t column) const
  {
    for (std::size_t i = column; i < this->Values.size(); i += this->Width)
    {
      if (!std::isnan(this->Values[i]))
      {
        return false;
      }
    }
    return true;
  }

  const std::vector<float>& Values;
  bool IsPTS;
  std::size_t Width, Used;
};

std::vector<float> channelsOf(const std::vector<float>& values, std::size_t width, const std::array<int, 3>& columns)
{
  std::vector<float> result;
  result.reserve(values.size() / width * 3);
  for (std::size_t row = 0; row < values.size(); row += width)
  {
    for (const int column : columns)
    {
      result.push_back(values[row + column]);
    }
  }
  return result;
}

Points pointsOf(const std::vector<float>& values, std::size_t width, const std::array<int, 3>& columns)
{
  Points points(values.size() / width);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const float* row = values.data() + i * width;
    points[i] = Eigen::Vector3f(row[columns[0]], row[columns[1]], row[columns[2]]);
  }
  return points;
}
}

MeasuredCloud readXYZ(const std::string& path, const Progress& progress)
{
  const std::string text = readText(path);
  report(progress, 0.0);
  Table table(path, text);
  table.start();
  std::vector<float> values;
  std::size_t lines = 0;
  do
  {
    table.take(values);
    if (++lines % 4096 == 0)
    {
      report(progress, 1.0 - static_cast<double>(table.left()) / text.size());
    }
  } while (table.next());
  if (table.promised() > lines)
  {
    failXYZ(
      path, "is cut off: it promises " + std::to_string(table.promised()) + " points and has " + std::to_string(lines));
  }
  const std::size_t width = table.width();
  const Columns columns = table.hasNames() ? table.columns() : Guess(values, width, table.promised() > 0).columns();
  MeasuredCloud result;
  result.cloud.points = pointsOf(values, width, columns.point);
  result.cloud.width = static_cast<int>(lines);
  result.cloud.height = 1;
  if (isWhole(columns.normal))
  {
    result.normals = pointsOf(values, width, columns.normal);
  }
  if (isWhole(columns.color))
  {
    const std::vector<float> colors = channelsOf(values, width, columns.color);
    const bool areReal =
      std::any_of(colors.begin(), colors.end(), [](float v) { return std::isfinite(v) && v != std::floor(v); }) ||
      std::none_of(colors.begin(), colors.end(), [](float v) { return v > 1.0f; });
    result.colors = colorValues(colors, areReal);
  }
  for (std::size_t i = 0; i < lines && columns.intensity >= 0; ++i)
  {
    result.intensities.push_back(values[i * width + columns.intensity]);
  }
  report(progress, 1.0);
  return result;
}

bool isXYZ(const std::string& path)
{
  try
  {
    const std::string text = readText(path, Beginning);
    Table(path, text).start();
    return true;
  }
  catch (const Error&)
  {
    return false;
  }
}
}
