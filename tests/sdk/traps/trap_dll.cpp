// SPDX-License-Identifier: Apache-2.0
// Entry point of a Windows library, unused here.
#include <windows.h>

BOOL WINAPI DllMain(HINSTANCE, DWORD, LPVOID) { return TRUE; }
