// SPDX-License-Identifier: Apache-2.0
// Which renderer a function means that is given no state: messages, files, aborting.
#pragma once

namespace oriel {
struct OutputRoots;
}

namespace oriel::sdk {

class Host;

/// The host whose shader ran last in this thread; in threads that never ran one, in the process.
/// Null where none has.
Host* current_host();
/// To be called before a shader runs.
void set_current_host(Host* host);
/// To be called before a host goes, by the thread it goes in.
void forget_host(const Host* host);

/// Where shaders may write pictures and where the names they read and write begin. Nothing may be
/// written until it is set.
void set_output_roots(const OutputRoots& roots);
OutputRoots output_roots();

}  // namespace oriel::sdk
