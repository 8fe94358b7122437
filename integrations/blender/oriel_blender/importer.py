# SPDX-License-Identifier: Apache-2.0
"""File > Import > mental ray (.mi)."""


def register():
    pass


def unregister():
    pass
