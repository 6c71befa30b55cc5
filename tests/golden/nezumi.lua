---@meta
--- What behaviours, systems and scenarios of nezumi are made of, for the Lua language server.
--- Written by `nezumi types --lua`; do not edit.

---@alias MessageType "TimedBoolean"|"TimedShort"|"TimedLong"|"TimedFloat"|"TimedDouble"|"TimedString"|"TimedBooleanSeq"|"TimedShortSeq"|"TimedLongSeq"|"TimedFloatSeq"|"TimedDoubleSeq"|"TimedStringSeq"|"TimedOctetSeq"|"TimedVelocity2D"|"TimedPose2D"|"TimedPose3D"|"RangeData"|"CameraImage"|"CameraIntrinsics"|"SeenMarkerSeq"|"NeighbourSeq"

---@class (exact) Velocity2D
---@field vx number [m/s] speed along the robot's x axis (forward)
---@field vy number [m/s] speed along the robot's y axis (left); 0 for two wheels that don't skid
---@field va number [rad/s] yaw rate, counter-clockwise

---@class (exact) Velocity2D.Written
---@field vx? number [m/s] speed along the robot's x axis (forward)
---@field vy? number [m/s] speed along the robot's y axis (left); 0 for two wheels that don't skid
---@field va? number [rad/s] yaw rate, counter-clockwise

---@class (exact) Point2D
---@field x number [m]
---@field y number [m]

---@class (exact) Point2D.Written
---@field x? number [m]
---@field y? number [m]

---@class (exact) Pose2D
---@field position Point2D place on the floor
---@field heading number [rad] direction, counter-clockwise from the x axis

---@class (exact) Pose2D.Written
---@field position? Point2D.Written place on the floor
---@field heading? number [rad] direction, counter-clockwise from the x axis

---@class (exact) Point3D
---@field x number [m]
---@field y number [m]
---@field z number [m]

---@class (exact) Point3D.Written
---@field x? number [m]
---@field y? number [m]
---@field z? number [m]

---@class (exact) Orientation3D
---@field r number [rad] roll about x
---@field p number [rad] pitch about y
---@field y number [rad] yaw about z, counter-clockwise

---@class (exact) Orientation3D.Written
---@field r? number [rad] roll about x
---@field p? number [rad] pitch about y
---@field y? number [rad] yaw about z, counter-clockwise

---@class (exact) Pose3D
---@field position Point3D place in space
---@field orientation Orientation3D roll, pitch and yaw

---@class (exact) Pose3D.Written
---@field position? Point3D.Written place in space
---@field orientation? Orientation3D.Written roll, pitch and yaw

---@class (exact) Size3D
---@field l number [m] along x
---@field w number [m] along y
---@field h number [m] along z

---@class (exact) Size3D.Written
---@field l? number [m] along x
---@field w? number [m] along y
---@field h? number [m] along z

---@class (exact) RangerElement
---@field pose Pose3D relative to the ranger
---@field size Size3D extent of the element

---@class (exact) RangerElement.Written
---@field pose? Pose3D.Written relative to the ranger
---@field size? Size3D.Written extent of the element

---@class (exact) RangerGeometry
---@field pose Pose3D in the robot's frame
---@field size Size3D extent of the device
---@field elements RangerElement[] the single transducers of the ranger

---@class (exact) RangerGeometry.Written
---@field pose? Pose3D.Written in the robot's frame
---@field size? Size3D.Written extent of the device
---@field elements? RangerElement.Written[] the single transducers of the ranger

---@class (exact) RangerConfig
---@field minAngle number [rad] first scan angle
---@field maxAngle number [rad] last scan angle
---@field angularRes number [rad] step from one scan angle to the next
---@field minRange number [m] shortest distance it measures
---@field maxRange number [m] longest distance it measures
---@field rangeRes number [m] resolution of a distance
---@field frequency number [Hz] scans per second

---@class (exact) RangerConfig.Written
---@field minAngle? number [rad] first scan angle
---@field maxAngle? number [rad] last scan angle
---@field angularRes? number [rad] step from one scan angle to the next
---@field minRange? number [m] shortest distance it measures
---@field maxRange? number [m] longest distance it measures
---@field rangeRes? number [m] resolution of a distance
---@field frequency? number [Hz] scans per second

---@class (exact) RangeData
---@field ranges number[] [m] distances, one per scan angle; inf: nothing within reach, -inf: too near, nan: no reading (REP 117)
---@field geometry RangerGeometry where the ranger is mounted
---@field config RangerConfig what the ranger can measure

---@class (exact) RangeData.Written
---@field ranges? number[] [m] distances, one per scan angle; inf: nothing within reach, -inf: too near, nan: no reading (REP 117)
---@field geometry? RangerGeometry.Written where the ranger is mounted
---@field config? RangerConfig.Written what the ranger can measure

---@class (exact) CameraImage
---@field width integer [px] 0..65535
---@field height integer [px] 0..65535
---@field bpp integer [bit] bits per pixel 0..65535
---@field format string how a pixel is stored, for example "rgb8" or "gray8"
---@field fDiv number scale factor of a compressed image
---@field pixels string the bytes, row by row from the top left; a string in Lua

---@class (exact) CameraImage.Written
---@field width? integer [px] 0..65535
---@field height? integer [px] 0..65535
---@field bpp? integer [bit] bits per pixel 0..65535
---@field format? string how a pixel is stored, for example "rgb8" or "gray8"
---@field fDiv? number scale factor of a compressed image
---@field pixels? string the bytes, row by row from the top left; a string in Lua

---@class (exact) CameraIntrinsics
---@field width integer [px] width of the pictures 0..65535
---@field height integer [px] 0..65535
---@field fx number [px] focal length in x; 0: unknown
---@field fy number [px] focal length in y
---@field cx number [px] column of the optical axis
---@field cy number [px] row of the optical axis
---@field k1 number radial distortion; below 0 a barrel, above a pincushion
---@field k2 number radial distortion
---@field p1 number tangential distortion
---@field p2 number tangential distortion
---@field k3 number radial distortion
---@field k4 number radial distortion of a rational model
---@field k5 number radial distortion of a rational model
---@field k6 number radial distortion of a rational model

---@class (exact) CameraIntrinsics.Written
---@field width? integer [px] width of the pictures 0..65535
---@field height? integer [px] 0..65535
---@field fx? number [px] focal length in x; 0: unknown
---@field fy? number [px] focal length in y
---@field cx? number [px] column of the optical axis
---@field cy? number [px] row of the optical axis
---@field k1? number radial distortion; below 0 a barrel, above a pincushion
---@field k2? number radial distortion
---@field p1? number tangential distortion
---@field p2? number tangential distortion
---@field k3? number radial distortion
---@field k4? number radial distortion of a rational model
---@field k5? number radial distortion of a rational model
---@field k6? number radial distortion of a rational model

---@class (exact) SeenMarker
---@field id integer number of the marker -2147483648..2147483647
---@field pose Pose3D from the camera: x forward, y left, z up

---@class (exact) SeenMarker.Written
---@field id? integer number of the marker -2147483648..2147483647
---@field pose? Pose3D.Written from the camera: x forward, y left, z up

---@class (exact) Neighbour
---@field name string of the robot
---@field range number [m] from the sensor to the robot's middle, seen from above
---@field bearing number [rad] counter-clockwise from the direction of the sensor
---@field message number[] the numbers that the robot sends to its neighbours, at most 10
---@field leds boolean[] which of the robot's LEDs are on

---@class (exact) Neighbour.Written
---@field name? string of the robot
---@field range? number [m] from the sensor to the robot's middle, seen from above
---@field bearing? number [rad] counter-clockwise from the direction of the sensor
---@field message? number[] the numbers that the robot sends to its neighbours, at most 10
---@field leds? boolean[] which of the robot's LEDs are on

---@class InPort
---@field is_new boolean there is an unread message
---@field tm number [s] stamp of the value, 0 before the first message
---@field age number [s] now() - tm, math.huge before the first message
---@field connected boolean
---@field stale boolean no message came for three periods of its sender, or none can come

---@class OutPort

---An in-port of TimedBoolean: one boolean.
---@class TimedBoolean.In : InPort
---@field read fun(self: TimedBoolean.In): boolean

---An out-port of TimedBoolean: one boolean.
---@class TimedBoolean.Out : OutPort
---@field write fun(self: TimedBoolean.Out, value: boolean)

---@class (exact) TimedBoolean.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedBoolean.OutOptions
---@field safe? boolean written when the component stops

---An in-port of TimedShort: one 16-bit integer from -32768 to 32767.
---@class TimedShort.In : InPort
---@field read fun(self: TimedShort.In): integer

---An out-port of TimedShort: one 16-bit integer from -32768 to 32767.
---@class TimedShort.Out : OutPort
---@field write fun(self: TimedShort.Out, value: integer)

---@class (exact) TimedShort.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedShort.OutOptions
---@field safe? integer written when the component stops

---An in-port of TimedLong: one 32-bit integer from -2147483648 to 2147483647.
---@class TimedLong.In : InPort
---@field read fun(self: TimedLong.In): integer

---An out-port of TimedLong: one 32-bit integer from -2147483648 to 2147483647.
---@class TimedLong.Out : OutPort
---@field write fun(self: TimedLong.Out, value: integer)

---@class (exact) TimedLong.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedLong.OutOptions
---@field safe? integer written when the component stops

---An in-port of TimedFloat: one 32-bit number.
---@class TimedFloat.In : InPort
---@field read fun(self: TimedFloat.In): number

---An out-port of TimedFloat: one 32-bit number.
---@class TimedFloat.Out : OutPort
---@field write fun(self: TimedFloat.Out, value: number)

---@class (exact) TimedFloat.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedFloat.OutOptions
---@field safe? number written when the component stops

---An in-port of TimedDouble: one 64-bit number.
---@class TimedDouble.In : InPort
---@field read fun(self: TimedDouble.In): number

---An out-port of TimedDouble: one 64-bit number.
---@class TimedDouble.Out : OutPort
---@field write fun(self: TimedDouble.Out, value: number)

---@class (exact) TimedDouble.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedDouble.OutOptions
---@field safe? number written when the component stops

---An in-port of TimedString: one string.
---@class TimedString.In : InPort
---@field read fun(self: TimedString.In): string

---An out-port of TimedString: one string.
---@class TimedString.Out : OutPort
---@field write fun(self: TimedString.Out, value: string)

---@class (exact) TimedString.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedString.OutOptions
---@field safe? string written when the component stops

---An in-port of TimedBooleanSeq: a sequence of booleans.
---@class TimedBooleanSeq.In : InPort
---@field read fun(self: TimedBooleanSeq.In): boolean[]

---An out-port of TimedBooleanSeq: a sequence of booleans.
---@class TimedBooleanSeq.Out : OutPort
---@field write fun(self: TimedBooleanSeq.Out, value: boolean[])

---@class (exact) TimedBooleanSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedBooleanSeq.OutOptions
---@field safe? boolean[] written when the component stops

---An in-port of TimedShortSeq: a sequence of 16-bit integers from -32768 to 32767.
---@class TimedShortSeq.In : InPort
---@field read fun(self: TimedShortSeq.In): integer[]

---An out-port of TimedShortSeq: a sequence of 16-bit integers from -32768 to 32767.
---@class TimedShortSeq.Out : OutPort
---@field write fun(self: TimedShortSeq.Out, value: integer[])

---@class (exact) TimedShortSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedShortSeq.OutOptions
---@field safe? integer[] written when the component stops

---An in-port of TimedLongSeq: a sequence of 32-bit integers from -2147483648 to 2147483647.
---@class TimedLongSeq.In : InPort
---@field read fun(self: TimedLongSeq.In): integer[]

---An out-port of TimedLongSeq: a sequence of 32-bit integers from -2147483648 to 2147483647.
---@class TimedLongSeq.Out : OutPort
---@field write fun(self: TimedLongSeq.Out, value: integer[])

---@class (exact) TimedLongSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedLongSeq.OutOptions
---@field safe? integer[] written when the component stops

---An in-port of TimedFloatSeq: a sequence of 32-bit numbers.
---@class TimedFloatSeq.In : InPort
---@field read fun(self: TimedFloatSeq.In): number[]

---An out-port of TimedFloatSeq: a sequence of 32-bit numbers.
---@class TimedFloatSeq.Out : OutPort
---@field write fun(self: TimedFloatSeq.Out, value: number[])

---@class (exact) TimedFloatSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedFloatSeq.OutOptions
---@field safe? number[] written when the component stops

---An in-port of TimedDoubleSeq: a sequence of 64-bit numbers.
---@class TimedDoubleSeq.In : InPort
---@field read fun(self: TimedDoubleSeq.In): number[]

---An out-port of TimedDoubleSeq: a sequence of 64-bit numbers.
---@class TimedDoubleSeq.Out : OutPort
---@field write fun(self: TimedDoubleSeq.Out, value: number[])

---@class (exact) TimedDoubleSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedDoubleSeq.OutOptions
---@field safe? number[] written when the component stops

---An in-port of TimedStringSeq: a sequence of strings.
---@class TimedStringSeq.In : InPort
---@field read fun(self: TimedStringSeq.In): string[]

---An out-port of TimedStringSeq: a sequence of strings.
---@class TimedStringSeq.Out : OutPort
---@field write fun(self: TimedStringSeq.Out, value: string[])

---@class (exact) TimedStringSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedStringSeq.OutOptions
---@field safe? string[] written when the component stops

---An in-port of TimedOctetSeq: bytes, in Lua a string.
---@class TimedOctetSeq.In : InPort
---@field read fun(self: TimedOctetSeq.In): string

---An out-port of TimedOctetSeq: bytes, in Lua a string.
---@class TimedOctetSeq.Out : OutPort
---@field write fun(self: TimedOctetSeq.Out, value: string)

---@class (exact) TimedOctetSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedOctetSeq.OutOptions
---@field safe? string written when the component stops

---An in-port of TimedVelocity2D: a velocity in the robot's own frame.
---@class TimedVelocity2D.In : InPort
---@field read fun(self: TimedVelocity2D.In): Velocity2D

---An out-port of TimedVelocity2D: a velocity in the robot's own frame.
---@class TimedVelocity2D.Out : OutPort
---@field write fun(self: TimedVelocity2D.Out, value: Velocity2D.Written)

---@class (exact) TimedVelocity2D.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedVelocity2D.OutOptions
---@field safe? Velocity2D.Written written when the component stops

---An in-port of TimedPose2D: a place and heading on the floor.
---@class TimedPose2D.In : InPort
---@field read fun(self: TimedPose2D.In): Pose2D

---An out-port of TimedPose2D: a place and heading on the floor.
---@class TimedPose2D.Out : OutPort
---@field write fun(self: TimedPose2D.Out, value: Pose2D.Written)

---@class (exact) TimedPose2D.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedPose2D.OutOptions
---@field safe? Pose2D.Written written when the component stops

---An in-port of TimedPose3D: a place and orientation in space.
---@class TimedPose3D.In : InPort
---@field read fun(self: TimedPose3D.In): Pose3D

---An out-port of TimedPose3D: a place and orientation in space.
---@class TimedPose3D.Out : OutPort
---@field write fun(self: TimedPose3D.Out, value: Pose3D.Written)

---@class (exact) TimedPose3D.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedPose3D.OutOptions
---@field safe? Pose3D.Written written when the component stops

---An in-port of RangeData: distances measured by a ranger.
---@class RangeData.In : InPort
---@field read fun(self: RangeData.In): RangeData

---An out-port of RangeData: distances measured by a ranger.
---@class RangeData.Out : OutPort
---@field write fun(self: RangeData.Out, value: RangeData.Written)

---@class (exact) RangeData.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) RangeData.OutOptions
---@field safe? RangeData.Written written when the component stops

---An in-port of CameraImage: a picture.
---@class CameraImage.In : InPort
---@field read fun(self: CameraImage.In): CameraImage

---An out-port of CameraImage: a picture.
---@class CameraImage.Out : OutPort
---@field write fun(self: CameraImage.Out, value: CameraImage.Written)

---@class (exact) CameraImage.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) CameraImage.OutOptions
---@field safe? CameraImage.Written written when the component stops

---An in-port of CameraIntrinsics: how a camera projects points in front of it to pixels.
---@class CameraIntrinsics.In : InPort
---@field read fun(self: CameraIntrinsics.In): CameraIntrinsics

---An out-port of CameraIntrinsics: how a camera projects points in front of it to pixels.
---@class CameraIntrinsics.Out : OutPort
---@field write fun(self: CameraIntrinsics.Out, value: CameraIntrinsics.Written)

---@class (exact) CameraIntrinsics.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) CameraIntrinsics.OutOptions
---@field safe? CameraIntrinsics.Written written when the component stops

---An in-port of SeenMarkerSeq: fiducial markers in sight.
---@class SeenMarkerSeq.In : InPort
---@field read fun(self: SeenMarkerSeq.In): SeenMarker[]

---An out-port of SeenMarkerSeq: fiducial markers in sight.
---@class SeenMarkerSeq.Out : OutPort
---@field write fun(self: SeenMarkerSeq.Out, value: SeenMarker.Written[])

---@class (exact) SeenMarkerSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) SeenMarkerSeq.OutOptions
---@field safe? SeenMarker.Written[] written when the component stops

---An in-port of NeighbourSeq: robots in sight and the numbers that they send, the nearest first.
---@class NeighbourSeq.In : InPort
---@field read fun(self: NeighbourSeq.In): Neighbour[]

---An out-port of NeighbourSeq: robots in sight and the numbers that they send, the nearest first.
---@class NeighbourSeq.Out : OutPort
---@field write fun(self: NeighbourSeq.Out, value: Neighbour.Written[])

---@class (exact) NeighbourSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) NeighbourSeq.OutOptions
---@field safe? Neighbour.Written[] written when the component stops

---Declares an in-port: `local range = input("range", "TimedShortSeq", "what it is")`.
---@overload fun(name: string, type: "TimedBoolean", doc?: string, options?: TimedBoolean.InOptions): TimedBoolean.In
---@overload fun(name: string, type: "TimedShort", doc?: string, options?: TimedShort.InOptions): TimedShort.In
---@overload fun(name: string, type: "TimedLong", doc?: string, options?: TimedLong.InOptions): TimedLong.In
---@overload fun(name: string, type: "TimedFloat", doc?: string, options?: TimedFloat.InOptions): TimedFloat.In
---@overload fun(name: string, type: "TimedDouble", doc?: string, options?: TimedDouble.InOptions): TimedDouble.In
---@overload fun(name: string, type: "TimedString", doc?: string, options?: TimedString.InOptions): TimedString.In
---@overload fun(name: string, type: "TimedBooleanSeq", doc?: string, options?: TimedBooleanSeq.InOptions): TimedBooleanSeq.In
---@overload fun(name: string, type: "TimedShortSeq", doc?: string, options?: TimedShortSeq.InOptions): TimedShortSeq.In
---@overload fun(name: string, type: "TimedLongSeq", doc?: string, options?: TimedLongSeq.InOptions): TimedLongSeq.In
---@overload fun(name: string, type: "TimedFloatSeq", doc?: string, options?: TimedFloatSeq.InOptions): TimedFloatSeq.In
---@overload fun(name: string, type: "TimedDoubleSeq", doc?: string, options?: TimedDoubleSeq.InOptions): TimedDoubleSeq.In
---@overload fun(name: string, type: "TimedStringSeq", doc?: string, options?: TimedStringSeq.InOptions): TimedStringSeq.In
---@overload fun(name: string, type: "TimedOctetSeq", doc?: string, options?: TimedOctetSeq.InOptions): TimedOctetSeq.In
---@overload fun(name: string, type: "TimedVelocity2D", doc?: string, options?: TimedVelocity2D.InOptions): TimedVelocity2D.In
---@overload fun(name: string, type: "TimedPose2D", doc?: string, options?: TimedPose2D.InOptions): TimedPose2D.In
---@overload fun(name: string, type: "TimedPose3D", doc?: string, options?: TimedPose3D.InOptions): TimedPose3D.In
---@overload fun(name: string, type: "RangeData", doc?: string, options?: RangeData.InOptions): RangeData.In
---@overload fun(name: string, type: "CameraImage", doc?: string, options?: CameraImage.InOptions): CameraImage.In
---@overload fun(name: string, type: "CameraIntrinsics", doc?: string, options?: CameraIntrinsics.InOptions): CameraIntrinsics.In
---@overload fun(name: string, type: "SeenMarkerSeq", doc?: string, options?: SeenMarkerSeq.InOptions): SeenMarkerSeq.In
---@overload fun(name: string, type: "NeighbourSeq", doc?: string, options?: NeighbourSeq.InOptions): NeighbourSeq.In
function input(name, type, doc, options) end

---Declares an out-port: `local target = output("target", "TimedVelocity2D", "what it is")`.
---@overload fun(name: string, type: "TimedBoolean", doc?: string, options?: TimedBoolean.OutOptions): TimedBoolean.Out
---@overload fun(name: string, type: "TimedShort", doc?: string, options?: TimedShort.OutOptions): TimedShort.Out
---@overload fun(name: string, type: "TimedLong", doc?: string, options?: TimedLong.OutOptions): TimedLong.Out
---@overload fun(name: string, type: "TimedFloat", doc?: string, options?: TimedFloat.OutOptions): TimedFloat.Out
---@overload fun(name: string, type: "TimedDouble", doc?: string, options?: TimedDouble.OutOptions): TimedDouble.Out
---@overload fun(name: string, type: "TimedString", doc?: string, options?: TimedString.OutOptions): TimedString.Out
---@overload fun(name: string, type: "TimedBooleanSeq", doc?: string, options?: TimedBooleanSeq.OutOptions): TimedBooleanSeq.Out
---@overload fun(name: string, type: "TimedShortSeq", doc?: string, options?: TimedShortSeq.OutOptions): TimedShortSeq.Out
---@overload fun(name: string, type: "TimedLongSeq", doc?: string, options?: TimedLongSeq.OutOptions): TimedLongSeq.Out
---@overload fun(name: string, type: "TimedFloatSeq", doc?: string, options?: TimedFloatSeq.OutOptions): TimedFloatSeq.Out
---@overload fun(name: string, type: "TimedDoubleSeq", doc?: string, options?: TimedDoubleSeq.OutOptions): TimedDoubleSeq.Out
---@overload fun(name: string, type: "TimedStringSeq", doc?: string, options?: TimedStringSeq.OutOptions): TimedStringSeq.Out
---@overload fun(name: string, type: "TimedOctetSeq", doc?: string, options?: TimedOctetSeq.OutOptions): TimedOctetSeq.Out
---@overload fun(name: string, type: "TimedVelocity2D", doc?: string, options?: TimedVelocity2D.OutOptions): TimedVelocity2D.Out
---@overload fun(name: string, type: "TimedPose2D", doc?: string, options?: TimedPose2D.OutOptions): TimedPose2D.Out
---@overload fun(name: string, type: "TimedPose3D", doc?: string, options?: TimedPose3D.OutOptions): TimedPose3D.Out
---@overload fun(name: string, type: "RangeData", doc?: string, options?: RangeData.OutOptions): RangeData.Out
---@overload fun(name: string, type: "CameraImage", doc?: string, options?: CameraImage.OutOptions): CameraImage.Out
---@overload fun(name: string, type: "CameraIntrinsics", doc?: string, options?: CameraIntrinsics.OutOptions): CameraIntrinsics.Out
---@overload fun(name: string, type: "SeenMarkerSeq", doc?: string, options?: SeenMarkerSeq.OutOptions): SeenMarkerSeq.Out
---@overload fun(name: string, type: "NeighbourSeq", doc?: string, options?: NeighbourSeq.OutOptions): NeighbourSeq.Out
function output(name, type, doc, options) end

---@alias ParameterValue boolean|integer|number|string|boolean[]|integer[]|number[]|string[]

---@class (exact) ParameterOptions
---@field min? number smallest value; of each element of an array (of numbers, arrays of numbers)
---@field max? number largest value; of each element of an array (of numbers, arrays of numbers)
---@field step? number step of the widget; other values are allowed too (of numbers, arrays of numbers)
---@field widget? "slider"|"spin"|"radio"|"checkbox"|"ordered_list"|"text" the control that changes the value: a slider needs both bounds, radio needs choices; a checkbox shows a boolean, or an array as a part of its choices; an ordered list shows an array of its choices
---@field unit? string for example "m/s"
---@field doc? string what it means
---@field choices? ParameterValue[] the allowed values; if omitted: all within the bounds
---@field min_size? integer smallest number of elements (of arrays of numbers, other arrays)
---@field max_size? integer largest number of elements (of arrays of numbers, other arrays)

---@class (exact) PortOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped (of input)
---@field safe? a value of the port's type written when the component stops (of output)

---@class (exact) AboutFields
---@field version? string of the file, for example "1.2"
---@field vendor? string who made it
---@field category? string what kind of component it is, for example "navigation"

---@class (exact) TaskOptions
---@field repeating? boolean starts again in the next execution after its end

---@class (exact) WaitOptions
---@field within? number [s] stops waiting after this time

---@class (exact) BoxFields
---@field at number[] [m] centre; without z it stands on the floor
---@field size number[] [m] length, width, height
---@field yaw? number [rad] turn about the vertical, counter-clockwise
---@field pitch? number [rad] makes a ramp: a positive one lowers the front; only without a mass
---@field color? string "#rrggbb" or the name of a colour
---@field mass? number [kg] a mass makes it movable

---@class (exact) WallFields
---@field from number[] [m] middle of one end
---@field to number[] [m] middle of the other end
---@field height? number [m]
---@field thickness? number [m]
---@field color? string as of a box

---@class (exact) CylinderFields
---@field at number[] [m] centre; without z it stands on the floor
---@field radius number [m]
---@field height number [m]
---@field color? string as of a box
---@field mass? number [kg] a mass makes it movable

---@class (exact) MarkerFields
---@field id integer the tag's number
---@field name? string for teleport; letters, digits and _
---@field size? number [m] edge of the black border
---@field at number[] [m] centre
---@field facing? number [rad] yaw of the direction that it faces

---@class (exact) MazeFields
---@field rows? string[] the maze as a drawing, the north first
---@field generate? MazePlanFields instead of `rows`: generates a maze
---@field cell? number [m] distance of two walls, from middle to middle; 0.09 in half-size contests
---@field thickness? number [m] of walls and posts; 0.006 in half-size contests
---@field at? number[] [m] centre of the south-west cell

---@class (exact) MazePlanFields
---@field columns? integer cells from west to east
---@field rows? integer cells from south to north
---@field seed? integer another seed, another maze

---@class (exact) FloorFields
---@field image string a picture (PNG, JPEG, BMP, TIFF, PPM, WebP ...); its upper edge lies towards positive y, its right one towards positive x
---@field size number[] [m] of the whole picture along x and y

---@class (exact) LineFields
---@field points? number[][] [m] `{ { x, y }, ... }`, two or more; a line whose last point is its first is closed
---@field width? number [m]
---@field color? string as of a box

---@class (exact) BorderFields
---@field thickness? number [m]
---@field height? number [m]

---@class (exact) ArenaFields
---@field size? number[] [m] inner length and width, the middle at the origin; without: unbounded
---@field border? boolean|BorderFields walls around `size`
---@field [integer] Thing|Thing[]

---@class (exact) LimitChangesFields
---@field speed? number [m/s] along x, both ways
---@field yaw_rate? number [rad/s] both ways
---@field acceleration? number [m/s^2] along x; also when braking
---@field yaw_acceleration? number [rad/s^2] of the yaw rate

---@class (exact) RobotFields
---@field model string a robot's file, for example "raspimouse"
---@field pose? { x?: number, y?: number, heading?: number } start pose
---@field limits? LimitChangesFields limits that replace those of the model
---@field backend? string "sim": simulated even with --hw; or the name of the driver that --hw uses
---@field calibrated? boolean use `NAME.calibration.lua` in the folder of this file also in simulation
---@field odometry_at_pose? boolean the odometry starts at `pose`, in the arena's coordinates; otherwise at 0, 0, 0
---@field active? boolean whether the component is activated at the start
---@field doc? string what it is
---@field mass? number [kg] of the whole robot
---@field friction? number friction of the simulated wheels on the floor: 1 is rubber, 0.1 is ice
---@field noise? number in simulation: standard deviation of each sensor that measures, relative to its value (0.05: 5 %), in addition to the sensor's own `noise`
---@field drive? DriveFields wheels, skids and limits
---@field body? BodyFields the hull
---@field sensors? table<string, SensorFields|false> by name
---@field actuators? table<string, ActuatorFields|false> by name
---@field ports? table<string, PortFields|false> by name
---@field hardware? HardwareFields the real robot's driver

---@class (exact) BehaviorFields
---@field script string a behaviour's file, for example "robot_controller"
---@field config? table<string, ParameterValue> values of the component's parameters
---@field sets? table<string, table<string, ParameterValue>> parameter sets: values that are chosen together, by the name of the set
---@field set? string the parameter set in use; omitted parameters have the values of `config`
---@field rate? number [Hz] executions per second, at most the tick rate
---@field active? boolean whether the component is activated at the start

---@class (exact) ComponentFields
---@field type string a native component's type, for example "Camera"
---@field config? table<string, ParameterValue> values of the component's parameters
---@field rate? number [Hz] executions per second, at most the tick rate
---@field on? string the robot that carries the component
---@field at? number[] [m] position on that robot, from the middle of the wheels' axis on the floor
---@field yaw? number [rad] direction on that robot, counter-clockwise
---@field backend? string "sim": simulated even with --hw
---@field active? boolean whether the component is activated at the start
---@field calibration? string for a Camera: the file that ROS's camera_calibration wrote, for example "ost.yaml"

---@class (exact) PhysicsFields
---@field step number [s] duration of a physics step; a tick is a whole number of them

---@class (exact) NetworkFields
---@field name string what other hosts call this one
---@field domain? integer hosts of one domain find each other
---@field interface? string the network interface, for example "wlan0"
---@field peers? string|string[] addresses of hosts, if the network has no multicast
---@field secret? string a file that `nezumi network secret` has made: hosts that have it may write
---@field open? boolean every host on the interface, or every user of this computer, may write without a secret
---@field lockstep? boolean connected simulations advance together, so that every run gives the same result
---@field hosts? string|string[] hosts that lockstep waits for before it begins, in addition to those of connections

---@class (exact) RosFields
---@field node string the node's name
---@field publish? table<string, string|RosTopicFields|any[]> out-ports and the topics that carry them: `["mouse.current_velocity_out"] = "/velocity"`
---@field subscribe? table<string, string|RosTopicFields> topics and the in-ports that take them: `["/cmd_vel"] = "mouse.target_velocity_in"`
---@field domain? integer the ROS_DOMAIN_ID of the other nodes
---@field interface? string the network interface, for example "wlan0"
---@field peers? string|string[] addresses of hosts, if the network has no multicast

---@class (exact) RosTopicFields
---@field topic? string of `publish`: its name, for example "/odom"
---@field port? string of `subscribe`: the in-port, "name.port"
---@field type? string the message's type, for example "geometry_msgs/msg/TwistStamped"
---@field frame? string the `frame_id` of the message's header

---@class (exact) RtmFields
---@field nameserver? string|string[] "HOST:PORT" of the CORBA name service, or of several
---@field export? string|string[] the components that appear as RTCs
---@field interface? string this computer's address, at which others reach them; by default only this computer reaches them
---@field rename? table<string, ParameterValue> the name of a port in OpenRTM, by `"name.port"`
---@field manager? boolean tools such as RTSystemEditor may add and remove behaviours, and end the run

---@class (exact) BodyFields
---@field shape? "box"|"cylinder"
---@field size? number[] [m] length, width, height; of a cylinder: diameter, diameter, height
---@field radius? number [m] instead of `size` (of cylinder)
---@field height? number [m] instead of `size` (of cylinder)
---@field at? number[] [m] centre of the hull; x, y from the middle of the wheels' axis, z from the floor

---@class (exact) LimitsFields
---@field speed? number [m/s] along x, both ways
---@field yaw_rate? number [rad/s] both ways
---@field acceleration? number [m/s^2] along x; also when braking
---@field yaw_acceleration? number [rad/s^2] of the yaw rate

---@class (exact) DriveFields
---@field radius? number [m] of the wheels
---@field left_radius? number [m] of the left wheel, if it is known to differ
---@field right_radius? number [m] of the right wheel, if it is known to differ
---@field track? number [m] between the wheels
---@field pulses_per_turn? number encoder pulses per turn of a wheel; 0: continuous
---@field skid? number [m] distance of the skids from the axis
---@field coasts_until_commanded? boolean the wheels roll freely until the first command after activation
---@field limits? LimitsFields each can be set again per robot in the system file
---@field hardware_limits? LimitsFields limits on the real robot, until its odometry is calibrated
---@field needs? string|string[] sensors that it needs to drive: it stops if one of them gave no value for 0.3 s
---@field port? string|string[] devices of the real robot's left and right motor

---@class (exact) SensorFields
---@field kind? "range"|"button"|"touch"|"gyro"|"color"|"reflect"|"ambient"|"scan"|"imu"|"neighbours" what it measures
---@field at? number[] [m] from the hull's centre
---@field yaw? number [rad] where it looks, counter-clockwise
---@field on? string the servo that carries it, instead of the hull
---@field range? number [m] largest distance that it sees (of range, scan)
---@field minimum? number [m] smallest distance that it sees (of range, scan)
---@field cone? number [rad] full opening angle, 0: a single ray; of a scan, its field of view (of range, scan)
---@field rays? integer rays in the cone: the nearest hit counts; a scan gives the distance of each, from right to left (of range, scan)
---@field noise? number standard deviation, in the value's unit; of an imu, of its rates in rad/s; of neighbours, of their ranges in m (of range, gyro, reflect, ambient, scan, imu, neighbours)
---@field acceleration_noise? number [m/s^2] standard deviation of its accelerations (of imu)
---@field table? string|number[][] a CSV file with the columns `distance_m` and `value` beside the robot file, or points `{ { 0.01, 1394 }, ... }`. Exact at its points; nearer than the first the value goes on as a power law, farther than the last it fades to `nothing` at `range` (of range)
---@field response? fun(distance: number): number instead of `table`: it is sampled when the file is read; `response(math.huge)` is the value with nothing in sight (of range)
---@field nothing? number the value with nothing in sight (of range)
---@field min_value? number lower bound of the value (of range)
---@field max_value? number upper bound of the value (of range)
---@field drift? number [rad/s] (of gyro)
---@field max_rate? number [rad/s] largest rate that it measures; 0: no limit (of gyro, imu)
---@field travel? number [m] way that it is pushed in until it closes (of touch)
---@field level? number light of the simulated room, from 0 (dark) to 100 (of ambient)
---@field radius? number [m] largest distance at which it sees robots (of neighbours)
---@field bearing_noise? number [rad] standard deviation of its bearings (of neighbours)
---@field loss? number probability that it misses a robot, each time (of neighbours)
---@field port? string which device of the real robot it is

---@class (exact) ActuatorFields
---@field kind? "leds"|"buzzer"|"servo"|"screen"|"speaker"
---@field count? integer number of lights (of leds)
---@field max_rate? number [rad/s] largest speed; 0: no limit (of servo)
---@field speed? number [rad/s] initial speed, the default of the robot's parameter `NAME_speed`. 0: as fast as possible, without this parameter (of servo)
---@field minimum? number [rad] (of servo)
---@field maximum? number [rad] equal to `minimum`: unlimited (of servo)
---@field at? number[] [m] its axis, from the hull's centre (of servo)
---@field port? string which device of the real robot it is

---@class (exact) PortFields
---@field type? string a message type
---@field from? string|string[] a sensor, a list of them, `"velocity"` (measured at the wheels), `"odometry"` or `"stalled"` (whether a wheel is blocked) (of out-port)
---@field to? string|string[] `"drive"`, `"odometry"` (sets it), `"say"` (at most 10 numbers, which `neighbours` of others see) or an actuator (of in-port)
---@field doc? string documentation for editors and the console
---@field rate? number [Hz] messages per second; 0: one each tick (of out-port)
---@field quantity? "value"|"distance"|"rate"|"acceleration" `"distance"`: metres instead of a range sensor's value; `"rate"`: of a gyro instead of its angle, of an imu its three rates; `"acceleration"`: of an imu its three accelerations (of out-port)
---@field queue? integer how many unread messages are kept; 0: the latest (of in-port)
---@field silence? "hold"|"off" after 0.5 s without a message: the actuator holds or goes off (of in-port)

---@class (exact) HardwareFields
---@field driver? string "raspimouse" or "ev3"
---@field script? string instead of `driver`: a behaviour that drives the robot through its devices
---@field devices? table<string, Device> of a `script`, by name: `{ line = serial { ... } }`
---@field device_model? string with `script`: a behaviour that stands for the devices in simulation, so that the driver runs there too
---@field start? string a sensor of kind `button`: the run waits until it is pressed
---@field shutdown? string a sensor of kind `button`: held for 3 s it ends the run and shuts the robot's computer down

---@class (exact) RobotModelFields
---@field base? string a robot file that this one builds on: omitted fields are those of the base. Tables with names are merged, lists and positions are replaced as a whole, `false` removes an entry
---@field doc? string what it is
---@field mass? number [kg] of the whole robot
---@field friction? number friction of the simulated wheels on the floor: 1 is rubber, 0.1 is ice
---@field noise? number in simulation: standard deviation of each sensor that measures, relative to its value (0.05: 5 %), in addition to the sensor's own `noise`
---@field drive? DriveFields wheels, skids and limits
---@field body? BodyFields the hull
---@field sensors? table<string, SensorFields|false> by name
---@field actuators? table<string, ActuatorFields|false> by name
---@field ports? table<string, PortFields|false> by name
---@field hardware? HardwareFields the real robot's driver

---@class (exact) PoseFields
---@field x? number [m]
---@field y? number [m]
---@field heading? number [rad] counter-clockwise; 0 is along x

---@class (exact) MarkerPoseFields
---@field x? number [m]
---@field y? number [m]
---@field z? number [m] height of the marker's centre
---@field heading? number [rad] direction that the marker faces

---@class (exact) VelocityConstraintFields
---@field vx? number [m/s] along the robot's x axis
---@field vy? number [m/s] along the robot's y axis
---@field va? number [rad/s] yaw rate, counter-clockwise
---@field seconds? number [s] how long (of s:disturb)

---@class (exact) HoldOptions
---@field take? boolean take the port even if another actor holds it

---@class (exact) CalibrationFields
---@field robot string its name in the system
---@field model string the robot model that was used in the measurement
---@field serial? string serial number of the robot's computer; another computer refuses the file
---@field odometry? OdometryCalibrationFields its wheels, from `nezumi calibrate odometry`
---@field sensors? table<string, { table: number[][] }> values of its range sensors at distances [m], from `nezumi calibrate ir`: `right_front = { table = { { 0.02, 795 }, ... } }`
---@field cameras? table<string, { width: integer, height: integer, fx: number, fy: number, cx: number, cy: number, k1: number, k2: number, p1: number, p2: number, k3: number }> the intrinsics of its cameras, from `nezumi calibrate camera`: by the camera's name, the fields of a CameraIntrinsics

---@class (exact) OdometryCalibrationFields
---@field track number [m] between the wheels
---@field left_radius number [m] of the left wheel
---@field right_radius number [m] of the right wheel

---@class (exact) ScenarioOptions
---@field timeout? number [s] simulated time after which the scenario fails
---@field sweep? table<string, any[]|Range> one run for each combination, `{ speed = { 0.1, 0.2 }, ... }`, the keys in sorted order. `range(lo, hi)` instead of a list draws numbers at random, `range(lo, hi, step)` draws from lo, lo + step, ...: all of them if there are at most `samples`, else without repetition
---@field samples? integer number of random draws. A failing draw is simplified: to numbers nearer to 0 and with fewer digits, and to earlier values in their list
---@field seeds? integer number of runs of each combination, each with its own seed
---@field seed? integer the seed of every run, as `nezumi run --seed` takes it
---@field search? integer number of runs that are chosen one after the other, from the sweep and from `s:any`, where margins are small and lines run for the first time. The search ends with the round of a failure, which is simplified
---@field paired? string a list of the sweep: runs that differ only in its value have the same seed, and the summary shows the differences of their measures

---@class (exact) ExpectationOptions
---@field within? number [s] time limit for the event, or for the start of the hold (of wait_until, eventually, maintain)
---@field hold number [s] how long the condition must stay true (of maintain)

---@class (exact) GoldenOptions
---@field tolerance? number largest allowed difference of a number

---@class (exact) LoadOptions
---@field robots? table<string, RobotModelFields> changes to the system's robots, by the robot's name

---@class (exact) ReloadOptions
---@field file? string the name of its script, searched as in a system file
---@field text? string the script itself

---@class (exact) RecordedOptions
---@field map? table<string, string> names of ports for topics, `{ ["/scan"] = "robot.scan" }`; only for recordings of other programs and of real robots

---@class (exact) JudgeOptions
---@field behavior string its file, or its name
---@field component? string the recorded component
---@field run string the recording or journal
---@field map? table<string, string> ports of topics, `{ ["/scan"] = "keeper.rays" }`: needed for recordings of other programs
---@field tolerance? number largest difference at which two numbers count as equal

---Declares a parameter, read as `config.name`. Its type follows the default: `30` integer, `0.0` number.
---@param name string
---@param default ParameterValue
---@param options? ParameterOptions
function param(name, default, options) end

---Defines a message type, in a separate file: `return message "Obstacle" { { "distance", "double", unit = "m" } }`.
---@param name string the name of the file: `light_sensors.lua` defines LightSensors
---@return fun(fields: table): nil
function message(name) end

---The constants of a message type that a file defines: `constants("sensor_msgs/Range").ULTRASOUND`.
---@param type MessageType
---@return table<string, boolean|number|string>
function constants(type) end

---@class Config
---@field [string] any

---The parameters that the file declares; `config.x = v` holds from the next tick.
---@type Config
config = {}

---A table that survives a reload. It can hold only plain data.
---@type table<any, any>
state = {}

---[s] Time since the start.
---@return number
function now() end

---[s] Time since the previous execution.
---@type number
dt = 0

---@class Log
---@field debug fun(...: any)
---@field info fun(...: any)
---@field warn fun(...: any)
---@field error fun(...: any)
log = {}

---The version, vendor and category of this component.
---@param fields AboutFields
function about(fields) end

---Declares a command, callable from console and scenario as `component:name(...)`.
---@param name string
---@param fn fun(...: any): any
---@param doc? string
function command(name, fn, doc) end

---Shows an internal value as `component.probes.name`; the last value of a tick counts. Recorded, but not in the trace.
---@param name string
---@param value number|boolean|string|table a table is flat, with at most 64 entries
function probe(name, value) end

---Declares a task, a function that waits between its steps. It starts on activation and runs from one wait to the next.
---@param name string
---@param fn fun()
---@param options? TaskOptions
function task(name, fn, options) end

---Starts a task at the next execution; an error if the task is already running.
---@param name string
function start(name) end

---Ends a task, and closes its `<close>` variables. Returns whether the task was running.
---@param name string
---@return boolean
function cancel(name) end

---Waits for this time; can be used only in a task. Returns the time that has passed [s].
---@param seconds number
---@return number
function wait(seconds) end

---Waits until `condition()` is true; can be used only in a task. Checks immediately, then in each execution. Returns
---false if the condition did not become true within the time limit of the options.
---@param condition fun(): any
---@param options? WaitOptions
---@return boolean
function wait_until(condition, options) end

---Called before the first execution after an activation.
function on_activated() end

---Called in every tick, or at the `rate` of the system file.
function on_execute() end

---Called when the component is deactivated or removed, or when the run ends.
function on_deactivated() end

---Called once when an error has stopped the component. May not write velocities.
function on_aborting() end

---Called in every tick while the component is in ERROR. May not write velocities.
function on_error() end

---Called when the component is reset; afterwards it is INACTIVE.
function on_reset() end

---Called in the new version of the file when it takes over from the old one.
---@param old_version integer
function on_reload(old_version) end

---@class Thing

---@class Maze: Thing
---@field columns integer cells from west to east
---@field rows integer cells from south to north
---@field start integer[] column and row, from 1, of the cell with S, otherwise of the south-west cell
---@field direction integer side on which the start cell is open, in quarter turns from east: 1 is north
---@field goal integer[] column and row of each cell with G, otherwise of the cells in the middle
---@field pose table x, y and heading of a robot at the start

---A box, fixed or movable.
---@param fields BoxFields
---@return Thing
function box(fields) end

---A wall on the floor from one place to another.
---@param fields WallFields
---@return Thing
function wall(fields) end

---An upright cylinder, fixed or movable.
---@param fields CylinderFields
---@return Thing
function cylinder(fields) end

---An AprilTag of the family 36h11, without thickness.
---@param fields MarkerFields
---@return Thing
function marker(fields) end

---The walls of a maze of square cells, as in the contests of micromice.
---@param fields string|MazeFields
---@return Maze
function maze(fields) end

---A picture on the floor, its middle at the origin.
---@param fields FloorFields
---@return Thing
function floor(fields) end

---A line painted on the floor; needs the arena's `size`, or a `floor`.
---@param fields LineFields
---@return Thing
function line(fields) end

---The floor and what stands on it. Several arenas add up.
---@param fields ArenaFields
function arena(fields) end

---A robot of the system.
---@param name string
---@param fields RobotFields
---@overload fun(name: string): fun(fields: RobotFields)
function robot(name, fields) end

---A component written in Lua.
---@param name string
---@param fields BehaviorFields
---@overload fun(name: string): fun(fields: BehaviorFields)
function behavior(name, fields) end

---A native component.
---@param name string
---@param fields ComponentFields
---@overload fun(name: string): fun(fields: ComponentFields)
function component(name, fields) end

---How the simulation runs.
---@param fields PhysicsFields
function physics(fields) end

---This system is one of several hosts. Without `network`, the system does not use the network.
---@param fields NetworkFields
function network(fields) end

---This system is a node among those of ROS 2.
---@param fields RosFields
function ros(fields) end

---Components that are visible to OpenRTM-aist components and can be connected to them.
---@param fields RtmFields
function rtm(fields) end

---A value with a default, which `--set name=value` overrides.
---@param name string
---@param default any
---@param options table?
---@return any
function argument(name, default, options) end

---Connects an out-port to an in-port of the same type.
---@param from string|Port "name.port", "rtm:NAME.port", or in a scenario the port itself
---@param to string|Port
function connect(from, to) end

---Fixed boxes from a file with rows x,y,z,lx,ly,lz,yaw.
---@param file string
---@return Thing
function csv(file) end

---Fixed boxes from a map of ROS: the occupied pixels of the picture that the YAML file names.
---@param file string
---@return Thing
function map(file) end

---Ticks per second; default 100.
---@param hz number
function rate(hz) end

---The seed of everything random in the run.
---@param n integer
function seed(n) end

---A model of robot: `return robot_model { ... }` is a robot file.
---@param fields RobotModelFields
---@return table
function robot_model(fields) end

---@class Device

---@class (exact) SerialFields
---@field path? string the device, such as /dev/ttyACM0
---@field vendor? string instead of `path`: the USB vendor's number, such as "2341"
---@field serial_number? string with `vendor`: the device's own serial number
---@field baud? integer [Bd] bits per second
---@field ends? string the end of each line, such as "\n": ports are TimedString then
---@field terminator? string instead of `ends`: the last bytes of each frame
---@field length? integer instead of `ends`: bytes of each frame
---@field cobs? boolean instead of `ends`: frames are encoded by COBS and end with 0
---@field safe? string|false the bytes that stop what the device moves: sent at every kind of stop, and when the engine dies; at most 255

---A device of a robot whose driver is a script.
---@param fields SerialFields
---@return Device
function serial(fields) end

---@class (exact) UdpFields
---@field host? string the device's address, such as "192.168.4.1"
---@field port? integer the device's port
---@field local_port? integer this computer's port; 0: any
---@field ends? string the end of each datagram's text: ports are TimedString then
---@field safe? string|false the bytes that stop what the device moves: sent at every kind of stop, and when the engine dies; at most 255

---A device of a robot whose driver is a script.
---@param fields UdpFields
---@return Device
function udp(fields) end

---@class (exact) I2cFields
---@field bus? integer the bus's number: 1 is /dev/i2c-1
---@field path? string instead of `bus`: the bus, such as /dev/i2c-1
---@field address? integer the device's address on the bus, 7 bits, such as 0x40
---@field registers? integer[] the registers that are read every period
---@field lengths? integer[] how many bytes are read from each register
---@field every? number [s] the period
---@field periods? number[] [s] instead of `every`: the period of each register
---@field number_bytes? integer the bytes of a register's number
---@field order? string with `number_bytes = 2`: "big": the higher byte first
---@field safe? string|false the bytes that stop what the device moves: sent at every kind of stop, and when the engine dies; at most 255

---A device of a robot whose driver is a script.
---@param fields I2cFields
---@return Device
function i2c(fields) end

---@class (exact) SpiFields
---@field bus? integer the bus's number: 0 of /dev/spidev0.1
---@field chip_select? integer the device's line: 1 of /dev/spidev0.1
---@field path? string instead of `bus` and `chip_select`: the device, such as /dev/spidev0.1
---@field speed? integer [Hz] of the clock
---@field mode? integer the clock's polarity and phase, as in the device's data sheet
---@field frames? string[] the bytes that are sent every period; the answer to each of them is read
---@field every? number [s] the period
---@field answers? boolean the answers to messages to the device are read too, as those to `frames`
---@field safe? string|false the bytes that stop what the device moves: sent at every kind of stop, and when the engine dies; at most 255

---A device of a robot whose driver is a script.
---@param fields SpiFields
---@return Device
function spi(fields) end

---@class (exact) GpioFields
---@field chip? integer the chip's number: 0 is /dev/gpiochip0
---@field path? string instead of `chip`: the chip, such as /dev/gpiochip0
---@field outputs? integer[] the chip's lines that are set
---@field inputs? integer[] the chip's lines whose edges are reported
---@field pull? string the resistors of the inputs
---@field debounce? number [s] how long a level of an input must last
---@field pwm_chip? integer the PWM chip's number: 0 is /sys/class/pwm/pwmchip0
---@field pwm_channels? integer[] the PWM chip's channels that are set
---@field pwm_frequency? number [Hz] of the PWM channels; 50 for servos
---@field safe? string|false the bytes that stop what the device moves: sent at every kind of stop, and when the engine dies; at most 255

---A device of a robot whose driver is a script.
---@param fields GpioFields
---@return Device
function gpio(fields) end

---A port as seen from outside: reading it here does not consume messages.
---@class Port
---@field age number time since the stamp of the latest message [s]; math.huge before the first message
---@field connected boolean whether another port is connected to this port
---@field count integer number of messages since the start
---@field direction "in"|"out" whether the component reads or writes the port
---@field doc string description of the port
---@field drop fun(self: Port) blocks all messages until release
---@field fields string[] fields of the messages, as in "position.x: number [m]", "ranges[]: number [m]"
---@field freeze fun(self: Port) repeats the present value until release
---@field hold fun(self: Port, value: any, options?: HoldOptions) sends only this value until release
---@field holder string? the actor that holds, drops or freezes the port, or nil
---@field inject fun(self: Port, value: any) delivers one message, as from a connection
---@field name string the port's name
---@field note string a note from the robot, for example that commands are ignored
---@field override string "held", "dropped", "frozen" or ""
---@field path string "name.port"
---@field peers string[] the ports that are connected to this port
---@field release fun(self: Port) ends a hold, drop or freeze
---@field stale boolean whether a message is overdue: none came for three periods of the sender, at least 0.1 s, or for 0.5 s if the sender declares no rate
---@field tm number stamp of the latest message [s], 0 before the first message
---@field type MessageType the port's message type
---@field unread boolean of an in-port: whether there is a message that the component has not read
---@field value any a copy of the latest message; the message stays unread. Before the first message, the zero value of its type
---@field write fun(self: Port, value: any) an out-port: publishes a message as if the component had written it; an in-port: the same as inject

---@class Component
---@field activate fun(self: Component): string makes the component ACTIVE; returns the new status
---@field battery number of robots: battery voltage [V], NaN while unknown: only of real robots that measure it
---@field buzzer integer of robots: tone of the robot's buzzer [Hz], 0 for silence
---@field collided boolean of robots: whether the robot touches something
---@field commands string[] the names of the component's commands
---@field config table<string, ParameterValue> the component's parameters; values must be within their bounds
---@field deactivate fun(self: Component): string makes the component INACTIVE; returns the new status
---@field disturb fun(self: Component, velocities?: VelocityConstraintFields) of robots: forces these velocities on the robot; without velocities it moves freely again
---@field error string? in ERROR: the error; otherwise nil
---@field failure { text: string, tm: number, file?: string, line?: integer, frames?: { file: string, line: integer, name?: string, locals: table }[] }? in ERROR: the error, its time [s], its line, and the functions that were running, the innermost first, each with file, line, name and locals; otherwise nil
---@field leds boolean[] of robots: which of the robot's lights are on
---@field limits table<string, number> of robots: the robot's limits of speed and acceleration
---@field name string the component's name
---@field ports table<string, Port> the component's ports by name
---@field press fun(self: Component, sensor: string, pressed?: boolean) of robots: presses a button or touch sensor; with false releases it
---@field probes table<string, ProbeView> the values of `probe` calls in the script: value, tm and age
---@field rate number executions per second [Hz]
---@field reset fun(self: Component): string takes the component out of ERROR; returns the new status
---@field said string[] of robots: the last 100 texts sent to the robot's speaker
---@field set string? the named set of parameters in use, or nil
---@field sets string[] the names of the component's parameter sets
---@field state table a copy of the script's `state`
---@field status "INACTIVE"|"ACTIVE"|"ERROR" "INACTIVE", "ACTIVE" or "ERROR"
---@field tasks table<string, TaskView> the component's tasks: status, since, waiting and line of each
---@field teleport fun(self: Component, pose: PoseFields) of robots: moves the robot to a pose, at rest
---@field touching string? of robots: what the robot touches, or nil
---@field truth { pose: Pose2D, velocity: Velocity2D, height: number, tilt: number } of robots: the robot's true state in simulation: pose, velocity, height, tilt
---@field type string the component's type
---@field use fun(self: Component, set: string): string switches to a named set of parameters
---@field version integer version number of the script, from 1
---@field [string] any its ports and commands

---@class TaskView
---@field status "inactive"|"ready"|"waiting"|"finished"|"cancelled"|"failed"
---@field since number [s] time of the last change of the status
---@field waiting? string what the task waits for, and the remaining time
---@field line? integer where it waits

---@class ProbeView
---@field value number|boolean|string|table
---@field tm number [s] time when the value was set
---@field age number [s]

---@alias World table<string, Component>
---@alias PortName Port|string a port or "name.port"
---@alias Condition fun(): any

---@class Range

---@param from number
---@param to number
---@param step? number without it any number between
---@return Range
function range(from, to, step) end

---@param name string
---@param options ScenarioOptions
---@param fn fun(s: Scenario, p: table<string, any>)
---@overload fun(name: string, fn: fun(s: Scenario))
function scenario(name, options, fn) end

---@class SpacePart
---@field [1] string its name
---@field count? integer number of values, 1 without it
---@field min? number
---@field max? number

---@class Environment
---@field system string the name of a system file
---@field ticks? integer of a step, 1 without it
---@field limit? integer steps after which an episode is truncated
---@field action (SpacePart|string)[]
---@field observation (SpacePart|string)[]
---@field start? fun(): table<string, any> values as of `--set`, for the system of this episode
---@field reset? fun(world: World) before the first tick
---@field act fun(world: World, action: number[])
---@field observe fun(world: World): any the numbers of the observation, also in nested lists
---@field reward fun(world: World, action: number[]): number
---@field terminated? fun(world: World): boolean

---Describes an environment for learning programs.
---@param description Environment
function environment(description) end

---@class Scenario
---@field seed integer of this run
---@field world World the components of the system, as soon as a system exists
---@field [string] Component a component of the system
local s = {}

---Loads a system file and activates its components. Its robots may differ by fields of a robot file.
---@param file string
---@param options? LoadOptions
---@return World
function s:load(file, options) end

---A recorded run as a world: its ports can be read while time moves through the recording. A journal, a recording
---of nezumi, or a recording of ROS 2 in MCAP.
---@param file string
---@param options? RecordedOptions
---@return World world
---@return number length [s] of the recording
function s:recorded(file, options) end

---Gives a behaviour the inputs of its component in a recorded run. Fails if an output differs from the recorded one.
---@param options JudgeOptions
function s:judge(options) end

---[s] Simulated time since the scenario began.
---@return number
function s:now() end

---The condition must be true after every tick, from now to the end of the scenario.
---@param name string
---@param condition Condition
---@overload fun(self: Scenario, name: string, options: ExpectationOptions, condition: Condition)
function s:always(name, condition) end

---The condition must be false after every tick, from now to the end of the scenario.
---@param name string
---@param condition Condition
---@overload fun(self: Scenario, name: string, options: ExpectationOptions, condition: Condition)
function s:never(name, condition) end

---Lets time pass.
---@param seconds number [s]
function s:run(seconds) end

---@param name string
---@param options ExpectationOptions
---@param condition Condition
function s:wait_until(name, options, condition) end

---@param name string
---@param options ExpectationOptions
---@param condition Condition
function s:eventually(name, options, condition) end

---@param name string
---@param options ExpectationOptions
---@param condition Condition
function s:maintain(name, options, condition) end

---@param value any
---@param message? string
function s:check(value, message) end

---@param actual number
---@param expected number
---@param tolerance number
---@param message? string
function s:near(actual, expected, tolerance, message) end

---Compares deeply; a failure shows both values.
---@param actual any
---@param expected any
---@param message? string
function s:equal(actual, expected, message) end

---Allows this component to go to ERROR from now on. Without this, ERROR fails the scenario.
---@param component Component|string
function s:allow_error(component) end

---Draws values, each from a range or list, by the seed of this run. A search chooses them. A failing run is simplified.
---@param name string
---@param values table<string, any[]|Range>
---@return table<string, any>
function s:any(name, values) end

---Keeps one number of this run under a name: `nezumi test --measures FILE.csv` has a row for each run.
---@param name string
---@param value number finite
---@param unit? string
function s:measure(name, value, unit) end

---Records these ports after every tick from now on, and compares them with a committed file beside the scenario file.
---@param file string
---@param options GoldenOptions
---@param ... PortName
---@overload fun(self: Scenario, file: string, ...: PortName)
function s:golden(file, options, ...) end

---Puts one message into a port, as if it came through a connection.
---@param port PortName
---@param value any
function s:inject(port, value) end

---The port has this value, whatever else is written, until `release`.
---@param port PortName
---@param value any
---@param options? HoldOptions
function s:hold(port, value, options) end

---@param port PortName
function s:release(port) end

---@param component Component|string
---@param new ReloadOptions
---@return boolean ok
---@return string? message
function s:reload(component, new) end

---No message gets through this port.
---@param port PortName
---@param seconds? number [s] without it until `restore`
function s:drop(port, seconds) end

---The port repeats its present value.
---@param port PortName
---@param seconds? number [s] without it until `restore`
function s:freeze(port, seconds) end

---Forces velocities on a robot, as if a hand moved it.
---@param robot Component|string
---@param velocities VelocityConstraintFields
function s:disturb(robot, velocities) end

---@param robot Component|string
---@param button string
---@param seconds? number [s] without it until `restore`
function s:press(robot, button, seconds) end

---Moves a robot, which is then at rest. Or moves a marker or object by its name; omitted fields keep their values.
---@param thing Component|string
---@param pose PoseFields|MarkerPoseFields
function s:teleport(thing, pose) end

---Emergency stop: every robot brakes as hard as it can and ignores commands, until `rearm`.
function s:stop() end

---Ends the emergency stop: robots obey commands from now on. All robots must stand still.
function s:rearm() end

---Ends what `drop`, `freeze`, `disturb` and `press` began.
---@param thing PortName|Component
function s:restore(thing) end

---A box, fixed or movable.
---@param fields BoxFields
---@return Thing
function s:box(fields) end

---A wall on the floor from one place to another.
---@param fields WallFields
---@return Thing
function s:wall(fields) end

---An upright cylinder, fixed or movable.
---@param fields CylinderFields
---@return Thing
function s:cylinder(fields) end

---An AprilTag of the family 36h11, without thickness.
---@param fields MarkerFields
---@return Thing
function s:marker(fields) end

---The walls of a maze of square cells, as in the contests of micromice.
---@param fields string|MazeFields
---@return Maze
function s:maze(fields) end

---A picture on the floor, its middle at the origin.
---@param fields FloorFields
---@return Thing
function s:floor(fields) end

---A line painted on the floor; needs the arena's `size`, or a `floor`.
---@param fields LineFields
---@return Thing
function s:line(fields) end

---The floor and what stands on it. Several arenas add up.
---@param fields ArenaFields
function s:arena(fields) end

---A robot of the system.
---@param name string
---@param fields RobotFields
---@overload fun(self: Scenario, name: string): fun(fields: RobotFields): Component
---@return Component
function s:robot(name, fields) end

---A component written in Lua.
---@param name string
---@param fields BehaviorFields
---@overload fun(self: Scenario, name: string): fun(fields: BehaviorFields): Component
---@return Component
function s:behavior(name, fields) end

---A native component.
---@param name string
---@param fields ComponentFields
---@overload fun(self: Scenario, name: string): fun(fields: ComponentFields): Component
---@return Component
function s:component(name, fields) end

---How the simulation runs.
---@param fields PhysicsFields
function s:physics(fields) end

---This system is one of several hosts. Without `network`, the system does not use the network.
---@param fields NetworkFields
function s:network(fields) end

---This system is a node among those of ROS 2.
---@param fields RosFields
function s:ros(fields) end

---Components that are visible to OpenRTM-aist components and can be connected to them.
---@param fields RtmFields
function s:rtm(fields) end

---Connects an out-port to an in-port of the same type.
---@param from string|Port "name.port", "rtm:NAME.port", or in a scenario the port itself
---@param to string|Port
function s:connect(from, to) end

---Fixed boxes from a file with rows x,y,z,lx,ly,lz,yaw.
---@param file string
---@return Thing
function s:csv(file) end

---Fixed boxes from a map of ROS: the occupied pixels of the picture that the YAML file names.
---@param file string
---@return Thing
function s:map(file) end

---Ticks per second; default 100.
---@param hz number
function s:rate(hz) end

