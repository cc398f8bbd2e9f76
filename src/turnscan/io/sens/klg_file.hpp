#pragma once
// .klg, the recordings of Logger2 for Kintinuous and ElasticFusion (github.com/mp3guy/Logger2,
// src/Logger2.h): the number of frames (32 bits), then for each frame its time (64 bits,
// microseconds), the bytes of depth and of colour (32 bits each), depth in millimetres (zlib, or as
// it is) and colour registered to it (JPEG, or RGB as it is). Little-endian. The size of the images
// is not stated. Logger2 gives its RGB to OpenCV's encoder as if it were BGR, and ElasticFusion
// (GUI/src/Tools/JPEGLoader.h) exchanges red and blue when it reads a JPEG file.

#include <turnscan/io/sens/sens_file.hpp>

namespace turnscan::sens {

/// As a .sens of the same content, without intrinsics and poses. The images have the size of the
/// first colour image, else 640 x 480. A file that was not closed states no frames and is read to
/// its end. Fails with kFormat if no whole frame is there or depth has another size, and as
/// read_index().
Result<Index> read_klg_index(const file::RandomAccessFile& file,
                             const RunContext& context = RunContext());

}  // namespace turnscan::sens
