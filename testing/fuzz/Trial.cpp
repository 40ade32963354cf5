// SPDX-License-Identifier: BSD-3-Clause
#include "Trial.h"

#include "base/Error.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

// The sanitizers'; null without them.
extern "C"
{
  __attribute__((weak)) int __sanitizer_install_malloc_and_free_hooks(
    void (*)(const volatile void*, std::size_t), void (*)(const volatile void*));
  __attribute__((weak)) std::size_t __sanitizer_get_allocated_size(const volatile void*);
}

namespace fuzz
{
namespace fs = std::filesystem;

namespace
{
std::atomic<std::ptrdiff_t> taken{ 0 };
std::atomic<std::ptrdiff_t> most{ PTRDIFF_MAX };

void onMalloc(const volatile void*, std::size_t size)
{
  const std::ptrdiff_t now = taken += static_cast<std::ptrdiff_t>(size);
  const std::ptrdiff_t allowed = most;
  if (now > allowed)
  {
    most = PTRDIFF_MAX; // what follows takes memory, too
    std::fprintf(
      stderr, "The reader takes %td bytes of memory, more than the %td that its file justifies\n", now, allowed);
    std::abort();
  }
}

void onFree(const volatile void* block)
{
  taken -= block ? static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(block)) : 0;
}

/// While it lives, what is taken at once is limited.
class Limit
{
public:
  explicit Limit(std::size_t bytes)
  {
    static const bool hooked =
      __sanitizer_install_malloc_and_free_hooks && __sanitizer_install_malloc_and_free_hooks(onMalloc, onFree);
    taken = 0;
    most = hooked ? static_cast<std::ptrdiff_t>(bytes) : PTRDIFF_MAX;
  }
  ~Limit() { most = PTRDIFF_MAX; }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;
};
}

Trial::Trial(const Reader& reader)
  : Tried(reader)
{
  const fs::path memory = "/dev/shm";
  const fs::path place = fs::is_directory(memory) ? memory : fs::temp_directory_path();
  this->Folder = place / ("meam-fuzz-" + std::to_string(getpid()) + "-" + reader.name);
  fs::create_directories(this->Folder);
}

Trial::~Trial()
{
  std::error_code failure;
  fs::remove_all(this->Folder, failure);
}

bool Trial::reads(const std::string& bytes) const
{
  const std::string path = (this->Folder / this->Tried.file).string();
  std::ofstream(path, std::ios::binary | std::ios::trunc)
    .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const Limit limit((this->Tried.megabytes << 20) + this->Tried.timesLength * bytes.size());
  try
  {
    this->Tried.read(path);
    return true;
  }
  catch (const meam::Error& error)
  {
    if (std::string(error.what()).empty())
    {
      throw std::logic_error("an error without a message");
    }
    return false;
  }
}
}
