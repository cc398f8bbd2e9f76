#pragma once
// The frames of a ROS bag: their times, the matching colour images, and missing frames.

#include <memory>
#include <turnscan/core/frame.hpp>
#include <turnscan/io/import_ros/rosbag_streams.hpp>
#include <vector>

namespace turnscan::importers {

/// Times are those of the messages' headers, relative to the first frame (if they decrease or are
/// zero, those of the recorder, with a note). A gap in the headers' sequence numbers, or in the
/// times if the numbers do not count frames, becomes frames marked dropped. The colour image is the
/// nearest in time, within three quarters of the frame interval. Reads the header of each message
/// but no pixels. Fails with kMissingData if there is no frame, and as Bag::read() for the first
/// one.
Result<std::unique_ptr<FrameSequence>> make_bag_sequence(rosbag::Bag bag, BagStreams streams,
                                                         SequenceHeader header);

}  // namespace turnscan::importers
