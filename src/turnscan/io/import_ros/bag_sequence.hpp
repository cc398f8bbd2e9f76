#pragma once
// The frames of a ROS bag: when each was taken, which colours belong to it, which are missing.

#include <memory>
#include <turnscan/core/frame.hpp>
#include <turnscan/io/import_ros/rosbag_streams.hpp>
#include <vector>

namespace turnscan::importers {

/// Times are those of the messages' headers, from the first frame on (where they run back or are
/// zero, those of the recorder, with a note). A gap in the headers' numbers, or in the times where
/// those do not count the frames, becomes frames marked dropped. Colours are those nearest in time,
/// within three quarters of the time between two frames. Reads the header of each message, no
/// pixels. Fails with kMissingData when there is no frame, and as Bag::read() for the first one.
Result<std::unique_ptr<FrameSequence>> make_bag_sequence(rosbag::Bag bag, BagStreams streams,
                                                         SequenceHeader header);

}  // namespace turnscan::importers
