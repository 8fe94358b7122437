// SPDX-License-Identifier: Apache-2.0
// The host for functions without a state argument: messages, files, aborting.
#pragma once

namespace oriel {
struct OutputRoots;
}

namespace oriel::sdk {

class Host;

/// The host of the shader that ran last in this thread, or in the process if this thread never ran
/// a shader. May be null.
Host* current_host();
/// Has to be called before a shader runs.
void set_current_host(Host* host);
/// Has to be called before a host is destroyed, by the destroying thread.
void forget_host(const Host* host);

/// Sets the folders that shaders may write pictures to, and the base of relative names. Before the
/// call nothing may be written.
void set_output_roots(const OutputRoots& roots);
OutputRoots output_roots();

}  // namespace oriel::sdk
