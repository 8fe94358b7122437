// SPDX-License-Identifier: Apache-2.0
// The entry point of a Windows library, which has no place here.
#include <windows.h>

BOOL WINAPI DllMain(HINSTANCE, DWORD, LPVOID) { return TRUE; }
