// SPDX-License-Identifier: BSD-3-Clause
// ppfmeam._core: meam.h and picks.h for Python. Settings keep the names of their C++ fields, by which choices.json
// knows them; ppfmeam's functions set them.
#include "Conversion.h"

PYBIND11_MODULE(_core, module)
{
  namespace py = pybind11;
  py::register_exception_translator(
    [](std::exception_ptr thrown)
    {
      try
      {
        std::rethrow_exception(thrown);
      }
      catch (const meam::Error& error)
      {
        PyErr_SetString(py::module_::import("ppfmeam").attr("Error").ptr(), error.what());
      }
    });
  meamPython::bindDetection(module);
  meamPython::bindPicks(module);
}
