#pragma once
// Pose of the table relative to the sensor.

#include <turnscan/core/frame.hpp>

namespace turnscan {

/// T_table_sensor of the sensor in whose frame the turntable is given (thesis eq. 3.10, corrected:
/// as printed it is the transpose). The rows of the rotation are the table's axes in sensor
/// coordinates: X = normalised(RA x O), Y = RA, Z = X x Y. If RA and O are parallel, X is the
/// sensor axis that is farthest from RA, made perpendicular to it.
/// Fails with kFormat unless axis and centre are finite and the axis has non-zero length.
Result<Pose> table_from_sensor(const TurntableInfo& turntable);

/// As table_from_sensor for sensor 0, or the sensor's own T_table_sensor if it is known, which
/// takes precedence. Fails with kMissingData if neither is known.
Result<Pose> sensor_pose(const SequenceHeader& header, std::size_t sensor);

}  // namespace turnscan
