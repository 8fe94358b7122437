# SPDX-License-Identifier: Apache-2.0
"""The hash of Cryptomatte: MurmurHash3 of 32 bits."""
import struct

MASK = 0xFFFFFFFF


def _rotate(x, bits):
    return ((x << bits) | (x >> (32 - bits))) & MASK


def murmur3(text):
    """MurmurHash3_x86_32 with seed 0 of the UTF-8 bytes."""
    data = text.encode("utf-8")
    h, tail = 0, len(data) // 4 * 4
    for i in range(0, tail, 4):
        k = int.from_bytes(data[i:i + 4], "little") * 0xCC9E2D51 & MASK
        h ^= _rotate(k, 15) * 0x1B873593 & MASK
        h = (_rotate(h, 13) * 5 + 0xE6546B64) & MASK
    if data[tail:]:
        k = int.from_bytes(data[tail:], "little") * 0xCC9E2D51 & MASK
        h ^= _rotate(k, 15) * 0x1B873593 & MASK
    h ^= len(data)
    h = (h ^ h >> 16) * 0x85EBCA6B & MASK
    h = (h ^ h >> 13) * 0xC2B2AE35 & MASK
    return h ^ h >> 16


def value(name):
    """The number of a name in the layers: its hash as the bits of a finite number."""
    bits = murmur3(name)
    exponent = bits >> 23 & 255
    if exponent in (0, 255):
        bits ^= 1 << 23
    return struct.unpack("<f", struct.pack("<I", bits))[0]


def identifier(layer):
    """The seven hexadecimal digits that metadata of a layer begin with."""
    return f"{murmur3(layer):08x}"[:7]
