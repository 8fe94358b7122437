// SPDX-License-Identifier: Apache-2.0
// Packets with file descriptors over a socket between processes.
#pragma once

#include <cstddef>
#include <optional>

#include "base/descriptor.h"

namespace oriel {

/// Sends a packet over a SOCK_SEQPACKET socket, with a descriptor unless it is negative. False on
/// errors.
bool send_packet(int socket, const void* bytes, std::size_t size, int descriptor = -1);

/// Receives a packet.
/// Inputs:  descriptor: receives the descriptor of the packet, or none; null: descriptors are
///          closed.
/// Returns: the size; unset on errors, at the end, and for packets of more than `capacity` bytes.
/// Checked: ConfinedProcess.*
std::optional<std::size_t> receive_packet(int socket, void* bytes, std::size_t capacity,
                                          Descriptor* descriptor = nullptr);

}  // namespace oriel
