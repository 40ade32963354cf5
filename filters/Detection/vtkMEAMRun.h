// SPDX-License-Identifier: BSD-3-Clause
/**
 * What every filter's RequestData shares: progress and abort as the core asks for them, and errors on VTK's channel.
 * Not wrapped.
 */
#ifndef vtkMEAMRun_h
#define vtkMEAMRun_h

#include "base/Error.h"

#include "vtkAlgorithm.h"

#include <initializer_list>

namespace vtkMEAMConversion
{
/// Progress and abort of a filter as the core asks for them.
meam::Progress progressOf(vtkAlgorithm* filter);

/// Whether the filter is asked for another piece than the first: of a parallel run one process does all the work, and
/// the data of the others are empty.
bool isLaterPiece(vtkAlgorithm* filter);

/// What may be connected to an input port. To VTK those that requireInputs() asks for are open, too.
enum class Connections
{
  One,
  OneOrNone,
  Any
};

/// Says in the information of an input port which types of data it takes. Returns 1.
int fillInputPort(vtkInformation* info, std::initializer_list<const char*> types, Connections connections);

/// What a writer does of each request: it asks for a piece of as many as there are processes, of which the first has
/// all. Otherwise each process would do all the work.
void requestPiece(vtkInformation* request, vtkInformationVector** inputs, int piece, int pieces);

/// Throws Error, which names the inputs that are not connected, of those that the filter cannot do without: of each
/// port its name, null where it may stay open. To VTK all of them are optional, because its own errors do not say what
/// to do.
void requireInputs(vtkAlgorithm* filter, std::initializer_list<const char*> names);

/// Throws Error without the name of a file: set FileName to `wanted`.
void requireFileName(const char* name, const char* wanted);

/// An error on VTK's channel. Where a request fails by it, the executive's own error about that is left out: it says no
/// more.
void reportError(vtkAlgorithm* filter, const char* message, bool failsRequest);
}

/**
 * The body of a RequestData: what the core throws becomes an error on VTK's channel with nothing in the
 * output, a wish to stop becomes an empty output. `work` is a callable, `outputs...` the data objects to
 * empty when it fails.
 */
template <typename Work, typename... Outputs>
int vtkMEAMRun(vtkAlgorithm* self, Work&& work, Outputs*... outputs)
{
  if (sizeof...(outputs) > 0 && vtkMEAMConversion::isLaterPiece(self))
  {
    (outputs->Initialize(), ...);
    return 1;
  }
  try
  {
    work();
    return 1;
  }
  catch (const meam::Aborted&)
  {
    (outputs->Initialize(), ...);
    return 1;
  }
  catch (const std::exception& error)
  {
    (outputs->Initialize(), ...);
    vtkMEAMConversion::reportError(self, error.what(), sizeof...(outputs) > 0);
    return 0;
  }
}

#endif
