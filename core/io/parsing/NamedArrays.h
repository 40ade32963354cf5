// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <cstring>
#include <list>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace meam
{
/// Arrays of numbers by name, as they lie in a binary file.
class NamedArrays
{
public:
  NamedArrays() = default;
  NamedArrays(NamedArrays&&) = default;
  NamedArrays& operator=(NamedArrays&&) = default;

  template <typename T>
  void set(const std::string& name, const std::vector<T>& values)
  {
    this->set(name, typeOf<T>(), values.data(), values.size() * sizeof(T));
  }
  void set(const std::string& name, const Points& values)
  {
    this->set(name, typeOf<float>(), values.data(), values.size() * sizeof(Eigen::Vector3f));
  }
  void set(const std::string& name, const std::string& text)
  {
    this->set(name, typeOf<char>(), text.data(), text.size());
  }

  /// The array of that name; empty when there is none. Throws Error when it holds another type of number.
  template <typename T>
  std::vector<T> get(const std::string& name) const
  {
    const std::string_view bytes = this->bytes(name, typeOf<T>(), sizeof(T));
    std::vector<T> values(bytes.size() / sizeof(T));
    copy(bytes, values.data());
    return values;
  }
  /// The same as vectors. Throws Error also when the last one is not complete.
  Points points(const std::string& name) const;
  std::string text(const std::string& name) const;
  /// Throws Error unless the array has one value.
  template <typename T>
  T value(const std::string& name) const
  {
    const std::string_view bytes = this->bytes(name, typeOf<T>(), sizeof(T));
    requireOne(name, bytes.size() == sizeof(T));
    T value;
    copy(bytes, &value);
    return value;
  }

  /// All arrays in a row, little-endian, with a check sum (CRC-32) at the end.
  std::string packed() const;
  /// The arrays in such bytes, which stay where they are and have to be there as long as these are read. Throws Error
  /// when they are cut off or damaged.
  static NamedArrays unpacked(std::string_view bytes);

private:
  struct Array
  {
    char type;
    std::string_view bytes;
  };

  template <typename T>
  static constexpr char typeOf()
  {
    if constexpr (std::is_same_v<T, double>)
    {
      return 'd';
    }
    else if constexpr (std::is_same_v<T, float>)
    {
      return 'f';
    }
    else if constexpr (std::is_same_v<T, char>)
    {
      return 'c';
    }
    else
    {
      static_assert(std::is_integral_v<T> && (sizeof(T) == 1 || sizeof(T) == 4));
      return sizeof(T) == 1 ? 'b' : std::is_signed_v<T> ? 'i' : 'u';
    }
  }
  static void copy(std::string_view bytes, void* to)
  {
    if (!bytes.empty())
    {
      std::memcpy(to, bytes.data(), bytes.size());
    }
  }
  static void requireOne(const std::string& name, bool isOne);
  void set(const std::string& name, char type, const void* values, std::size_t size);
  std::string_view bytes(const std::string& name, char type, std::size_t size) const;

  std::map<std::string, Array> Arrays;
  std::list<std::string> Own; ///< of those that were set
};
}
