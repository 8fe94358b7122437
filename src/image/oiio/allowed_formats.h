// SPDX-License-Identifier: Apache-2.0
// The image formats that are read. The image library knows more, whose readers are large (video,
// camera RAW, DICOM, PSD) and rarely tested with damaged files.
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

namespace oriel::oiio {

/// Opens an image by the reader of its extension, else by that of its first bytes. Other readers of
/// the image library are never tried.
///
/// Errors:  std::runtime_error with the reason.
/// Checked: ReaderProcess.OtherFormatsAreRefusedInEveryMode
std::unique_ptr<OIIO::ImageInput> open_allowed(const std::string& path,
                                               const OIIO::ImageSpec* config = nullptr);

}  // namespace oriel::oiio
