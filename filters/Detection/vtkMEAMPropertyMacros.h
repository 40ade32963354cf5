// SPDX-License-Identifier: BSD-3-Clause
/**
 * Set and Get methods of a property in one line. A setting is a field of the core's settings struct, of which
 * vtkMEAMSettings.h defines the methods; the others are members of the filter.
 */
#ifndef vtkMEAMPropertyMacros_h
#define vtkMEAMPropertyMacros_h

#include "vtkSetGet.h"

#define vtkMEAMDeclareSettingMacro(name, type)                                                                         \
  virtual void Set##name(type value);                                                                                  \
  virtual type Get##name()

/// One that is on or off.
#define vtkMEAMDeclareFlagMacro(name)                                                                                  \
  vtkMEAMDeclareSettingMacro(name, bool);                                                                              \
  vtkBooleanMacro(name, bool)

#define vtkMEAMMemberMacro(name, type)                                                                                 \
  vtkSetMacro(name, type);                                                                                             \
  vtkGetMacro(name, type)

#define vtkMEAMClampedMemberMacro(name, type, low, high)                                                               \
  vtkSetClampMacro(name, type, low, high);                                                                             \
  vtkGetMacro(name, type)

#define vtkMEAMVectorMemberMacro(name, type, count)                                                                    \
  vtkSetVector##count##Macro(name, type);                                                                              \
  vtkGetVector##count##Macro(name, type)

#define vtkMEAMFileMemberMacro(name)                                                                                   \
  vtkSetFilePathMacro(name);                                                                                           \
  vtkGetFilePathMacro(name)

#endif
