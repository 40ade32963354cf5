// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"

#include <optional>
#include <string>

namespace meam
{
/// What `work` returns, in a process of its own: a library that crashes or prints does so there. An Error of `work`
/// comes out here; none is what it was when the process ended without a result. Threads of the caller do not exist in
/// `work`, so that it must not wait for any. A wish to stop ends it at once.
std::optional<std::string> runInChildProcess(const std::function<std::string()>& work, const Progress& progress);
}
