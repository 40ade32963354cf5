// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/NamedArrays.h"

#include "base/Error.h"

#include <zlib.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "The arrays are written as they lie in memory: little-endian"
#endif

namespace meam
{
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "points lie one after the other");

namespace
{
template <typename T>
void append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Takes one piece after the other off the front.
class Front
{
public:
  explicit Front(std::string_view bytes)
    : Bytes(bytes)
  {
  }
  bool isEmpty() const { return this->Bytes.empty(); }
  std::string_view bytes(std::uint64_t count)
  {
    if (count > this->Bytes.size())
    {
      throw Error("is cut off or damaged");
    }
    const std::string_view piece = this->Bytes.substr(0, count);
    this->Bytes.remove_prefix(count);
    return piece;
  }
  template <typename T>
  T number()
  {
    T value;
    std::memcpy(&value, this->bytes(sizeof(T)).data(), sizeof(T));
    return value;
  }

private:
  std::string_view Bytes;
};

std::uint32_t checksum(std::string_view bytes)
{
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}
}

void NamedArrays::set(const std::string& name, char type, const void* values, std::size_t size)
{
  this->Own.emplace_back(static_cast<const char*>(values), size);
  this->Arrays[name] = { type, this->Own.back() };
}

std::string_view NamedArrays::bytes(const std::string& name, char type, std::size_t size) const
{
  const auto found = this->Arrays.find(name);
  if (found == this->Arrays.end())
  {
    return {};
  }
  if (found->second.type != type || found->second.bytes.size() % size != 0)
  {
    throw Error("is damaged: its array '" + name + "' holds other numbers than expected");
  }
  return found->second.bytes;
}

Points NamedArrays::points(const std::string& name) const
{
  const std::string_view bytes = this->bytes(name, typeOf<float>(), sizeof(Eigen::Vector3f));
  Points points(bytes.size() / sizeof(Eigen::Vector3f));
  copy(bytes, points.data());
  return points;
}

std::string NamedArrays::text(const std::string& name) const
{
  return std::string(this->bytes(name, typeOf<char>(), sizeof(char)));
}

void NamedArrays::requireOne(const std::string& name, bool isOne)
{
  if (!isOne)
  {
    throw Error("is incomplete: it has no '" + name + "'");
  }
}

std::string NamedArrays::packed() const
{
  std::string bytes;
  for (const auto& [name, array] : this->Arrays)
  {
    append(bytes, static_cast<std::uint32_t>(name.size()));
    bytes += name;
    bytes += array.type;
    append(bytes, static_cast<std::uint64_t>(array.bytes.size()));
    bytes += array.bytes;
  }
  append(bytes, checksum(bytes));
  return bytes;
}

NamedArrays NamedArrays::unpacked(std::string_view bytes)
{
  if (bytes.size() < sizeof(std::uint32_t))
  {
    throw Error("is cut off");
  }
  const std::string_view content = bytes.substr(0, bytes.size() - sizeof(std::uint32_t));
  if (Front(bytes.substr(content.size())).number<std::uint32_t>() != checksum(content))
  {
    throw Error("is cut off or damaged: its check sum does not fit");
  }
  NamedArrays arrays;
  for (Front front(content); !front.isEmpty();)
  {
    const std::string name(front.bytes(front.number<std::uint32_t>()));
    const char type = front.number<char>();
    const std::string_view values = front.bytes(front.number<std::uint64_t>());
    arrays.Arrays[name] = { type, values };
  }
  return arrays;
}
}
