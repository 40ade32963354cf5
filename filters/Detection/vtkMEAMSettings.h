// SPDX-License-Identifier: BSD-3-Clause
/**
 * Properties of filters that hold the core's settings struct, `this->Settings` (a pointer to it). For the .cxx files of
 * filters; not wrapped.
 */
#ifndef vtkMEAMSettings_h
#define vtkMEAMSettings_h

#include <algorithm>
#include <type_traits>

/// Defines SetNAME and GetNAME of a class as a field of its settings, kept within bounds; the field may be an
/// enumeration.
#define vtkMEAMClampedSettingMacro(thisClass, name, type, field, low, high)                                            \
  void thisClass::Set##name(type value)                                                                                \
  {                                                                                                                    \
    using Field = std::decay_t<decltype(this->Settings->field)>;                                                       \
    const auto wanted = static_cast<Field>(std::clamp<type>(value, low, high));                                        \
    if (this->Settings->field != wanted)                                                                               \
    {                                                                                                                  \
      this->Settings->field = wanted;                                                                                  \
      this->Modified();                                                                                                \
    }                                                                                                                  \
  }                                                                                                                    \
  type thisClass::Get##name() { return static_cast<type>(this->Settings->field); }

/// The same of a field that may have any value.
#define vtkMEAMSettingMacro(thisClass, name, type, field)                                                              \
  void thisClass::Set##name(type value)                                                                                \
  {                                                                                                                    \
    if (this->Settings->field != value)                                                                                \
    {                                                                                                                  \
      this->Settings->field = value;                                                                                   \
      this->Modified();                                                                                                \
    }                                                                                                                  \
  }                                                                                                                    \
  type thisClass::Get##name() { return this->Settings->field; }

/// Defines SetParametersToNAME, which sets all of them.
#define vtkMEAMParametersMacro(thisClass, name, settings)                                                              \
  void thisClass::SetParametersTo##name()                                                                              \
  {                                                                                                                    \
    *this->Settings = settings;                                                                                        \
    this->Modified();                                                                                                  \
  }

#endif
