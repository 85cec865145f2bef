// Names that <windows.h> turns into something else, as it does unless it is told not to (NOMINMAX, WIN32_LEAN_AND_MEAN).
// MinGW's own leaves out min and max in C++; the maker's does not.  After the standard library's and Eigen's headers, before all of hapbeam's: tests/compile.
// Source: minwindef.h, windef.h, rpcndr.h, basetyps.h, winnt.h, wingdi.h and winuser.h of MinGW-w64 10.
#pragma once

#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#ifndef _WIN32
#define near
#define far
#define NEAR
#define FAR
#define pascal
#define cdecl
#define small char
#define hyper long long
#define interface struct
#define IN
#define OUT
#define OPTIONAL
#define CONST const
#define VOID void
#define STRICT 1
#define TRUE 1
#define FALSE 0
#define ERROR 0
#define NO_ERROR 0L
#define DELETE 0x00010000L
#define IGNORE 0
#define INFINITE 0xffffffff
#define ABSOLUTE 1
#define RELATIVE 2
#define TRANSPARENT 1
#define OPAQUE 2
#define DIFFERENCE 11
#define PLANES 14
#define CALLBACK
#define APIENTRY
#define THIS_FILE
#define GetObject GetObjectA
#define GetMessage GetMessageA
#define CreateWindow(a, b) CreateWindowA(a, b)
#endif
