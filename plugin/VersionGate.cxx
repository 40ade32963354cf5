// SPDX-License-Identifier: BSD-3-Clause
// PPFMEAM.so, the library that ParaView opens. It links nothing of ParaView, nor the C++ library, so that every
// ParaView can open it, looks in which one it is, and opens the plugin itself only in the one that this was built for.
// ParaView compares no versions: a plugin for another one lacks libraries, or brings a second ParaView into the
// process and crashes it.
#include <dlfcn.h>
#include <link.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

class vtkPVPlugin;

namespace
{
constexpr const char* Built = PPFMEAM_PARAVIEW_VERSION; // as "5.11"

/// The version of ParaView in the name of its library, "5.13" in libvtkRemotingCore-pv5.13.so.1; empty if there is none.
struct Version
{
  char Text[32] = "";
};

/// For dl_iterate_phdr: stops at ParaView's library.
int findVersion(dl_phdr_info* library, std::size_t /*size*/, void* found)
{
  constexpr const char* Name = "/libvtkRemotingCore-pv";
  const char* version = std::strstr(library->dlpi_name, Name);
  if (!version)
  {
    return 0;
  }
  version += std::strlen(Name);
  const char* end = std::strstr(version, ".so");
  const int length = end ? static_cast<int>(end - version) : 0;
  std::snprintf(static_cast<Version*>(found)->Text, sizeof(Version::Text), "%.*s", length, version);
  return 1;
}

/// Says it where ParaView says its own errors: VTK's function for that has the same name in all versions.
void complain(const char* sentence, const Version& running)
{
  char name[64];
  std::snprintf(name, sizeof(name), "libvtkCommonCore-pv%s.so.1", running.Text);
  void* vtk = dlopen(name, RTLD_LAZY | RTLD_NOLOAD);
  using Show = void (*)(const char*);
  const auto show = vtk ? reinterpret_cast<Show>(dlsym(vtk, "_Z31vtkOutputWindowDisplayErrorTextPKc")) : nullptr;
  if (show)
  {
    show(sentence);
  }
  else
  {
    std::fprintf(stderr, "%s\n", sentence);
  }
}

/// Opens the plugin itself, which is in the folder of this library, wherever links to it are.
void* openPlugin()
{
  Dl_info own;
  char file[PATH_MAX];
  if (!dladdr(reinterpret_cast<void*>(&openPlugin), &own) || !own.dli_fname || !realpath(own.dli_fname, file))
  {
    return nullptr;
  }
  const int length = static_cast<int>(std::strrchr(file, '/') + 1 - file);
  char path[PATH_MAX + sizeof(PPFMEAM_PLUGIN_FILE)];
  std::snprintf(path, sizeof(path), "%.*s%s", length, file, PPFMEAM_PLUGIN_FILE);
  return dlopen(path, RTLD_LAZY | RTLD_LOCAL);
}
}

/// What ParaView asks a plugin for; after nullptr it goes on without it.
extern "C" __attribute__((visibility("default"))) vtkPVPlugin* pv_plugin_instance()
{
  char sentence[2048];
  Version running;
  dl_iterate_phdr(findVersion, &running);
  if (running.Text[0] && std::strcmp(running.Text, Built) != 0)
  {
    std::snprintf(sentence, sizeof(sentence),
      "The plugin PPFMEAM was built for ParaView %s and this is ParaView %s: load the one that was built for it.",
      Built, running.Text);
    complain(sentence, running);
    return nullptr;
  }
  void* plugin = openPlugin();
  using Instance = vtkPVPlugin* (*)();
  const auto instance = plugin ? reinterpret_cast<Instance>(dlsym(plugin, "pv_plugin_instance")) : nullptr;
  if (!instance)
  {
    const char* reason = dlerror();
    std::snprintf(
      sentence, sizeof(sentence), "The plugin PPFMEAM cannot be loaded: %s", reason ? reason : "no reason given");
    complain(sentence, running);
    return nullptr;
  }
  return instance();
}
