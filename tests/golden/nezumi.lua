---@meta
--- What behaviours, systems and scenarios of nezumi are made of, for the Lua language server.
--- Written by `nezumi types --lua`; do not edit.

---@alias MessageType "TimedBoolean"|"TimedShort"|"TimedLong"|"TimedFloat"|"TimedDouble"|"TimedString"|"TimedBooleanSeq"|"TimedShortSeq"|"TimedLongSeq"|"TimedFloatSeq"|"TimedDoubleSeq"|"TimedStringSeq"|"TimedVelocity2D"|"TimedPose2D"|"TimedPose3D"|"RangeData"|"CameraImage"|"CameraIntrinsics"|"SeenMarkerSeq"|"builtin_interfaces/Duration"|"builtin_interfaces/Time"|"geometry_msgs/Accel"|"geometry_msgs/AccelStamped"|"geometry_msgs/AccelWithCovariance"|"geometry_msgs/AccelWithCovarianceStamped"|"geometry_msgs/Inertia"|"geometry_msgs/InertiaStamped"|"geometry_msgs/Point"|"geometry_msgs/Point32"|"geometry_msgs/PointStamped"|"geometry_msgs/Polygon"|"geometry_msgs/PolygonStamped"|"geometry_msgs/Pose"|"geometry_msgs/Pose2D"|"geometry_msgs/PoseArray"|"geometry_msgs/PoseStamped"|"geometry_msgs/PoseWithCovariance"|"geometry_msgs/PoseWithCovarianceStamped"|"geometry_msgs/Quaternion"|"geometry_msgs/QuaternionStamped"|"geometry_msgs/Transform"|"geometry_msgs/TransformStamped"|"geometry_msgs/Twist"|"geometry_msgs/TwistStamped"|"geometry_msgs/TwistWithCovariance"|"geometry_msgs/TwistWithCovarianceStamped"|"geometry_msgs/Vector3"|"geometry_msgs/Vector3Stamped"|"geometry_msgs/Wrench"|"geometry_msgs/WrenchStamped"|"nav_msgs/GridCells"|"nav_msgs/MapMetaData"|"nav_msgs/OccupancyGrid"|"nav_msgs/Odometry"|"nav_msgs/Path"|"raspimouse_msgs/Leds"|"raspimouse_msgs/LightSensors"|"raspimouse_msgs/Switches"|"sensor_msgs/BatteryState"|"sensor_msgs/CameraInfo"|"sensor_msgs/ChannelFloat32"|"sensor_msgs/CompressedImage"|"sensor_msgs/FluidPressure"|"sensor_msgs/Illuminance"|"sensor_msgs/Image"|"sensor_msgs/Imu"|"sensor_msgs/JointState"|"sensor_msgs/Joy"|"sensor_msgs/JoyFeedback"|"sensor_msgs/JoyFeedbackArray"|"sensor_msgs/LaserEcho"|"sensor_msgs/LaserScan"|"sensor_msgs/MagneticField"|"sensor_msgs/MultiDOFJointState"|"sensor_msgs/MultiEchoLaserScan"|"sensor_msgs/NavSatFix"|"sensor_msgs/NavSatStatus"|"sensor_msgs/PointCloud"|"sensor_msgs/PointCloud2"|"sensor_msgs/PointField"|"sensor_msgs/Range"|"sensor_msgs/RegionOfInterest"|"sensor_msgs/RelativeHumidity"|"sensor_msgs/Temperature"|"sensor_msgs/TimeReference"|"std_msgs/Bool"|"std_msgs/Byte"|"std_msgs/ByteMultiArray"|"std_msgs/Char"|"std_msgs/ColorRGBA"|"std_msgs/Empty"|"std_msgs/Float32"|"std_msgs/Float32MultiArray"|"std_msgs/Float64"|"std_msgs/Float64MultiArray"|"std_msgs/Header"|"std_msgs/Int16"|"std_msgs/Int16MultiArray"|"std_msgs/Int32"|"std_msgs/Int32MultiArray"|"std_msgs/Int64"|"std_msgs/Int64MultiArray"|"std_msgs/Int8"|"std_msgs/Int8MultiArray"|"std_msgs/MultiArrayDimension"|"std_msgs/MultiArrayLayout"|"std_msgs/String"|"std_msgs/UInt16"|"std_msgs/UInt16MultiArray"|"std_msgs/UInt32"|"std_msgs/UInt32MultiArray"|"std_msgs/UInt64"|"std_msgs/UInt64MultiArray"|"std_msgs/UInt8"|"std_msgs/UInt8MultiArray"

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
---@field position Point2D where
---@field heading number [rad] direction, counter-clockwise from the x axis

---@class (exact) Pose2D.Written
---@field position? Point2D.Written where
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
---@field position Point3D where
---@field orientation Orientation3D roll, pitch and yaw

---@class (exact) Pose3D.Written
---@field position? Point3D.Written where
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
---@field elements RangerElement[] its single transducers

---@class (exact) RangerGeometry.Written
---@field pose? Pose3D.Written in the robot's frame
---@field size? Size3D.Written extent of the device
---@field elements? RangerElement.Written[] its single transducers

---@class (exact) RangerConfig
---@field minAngle number [rad] first scan angle
---@field maxAngle number [rad] last scan angle
---@field angularRes number [rad] angle between two scans
---@field minRange number [m] shortest distance it measures
---@field maxRange number [m] longest distance it measures
---@field rangeRes number [m] resolution of a distance
---@field frequency number [Hz] scans per second

---@class (exact) RangerConfig.Written
---@field minAngle? number [rad] first scan angle
---@field maxAngle? number [rad] last scan angle
---@field angularRes? number [rad] angle between two scans
---@field minRange? number [m] shortest distance it measures
---@field maxRange? number [m] longest distance it measures
---@field rangeRes? number [m] resolution of a distance
---@field frequency? number [Hz] scans per second

---@class (exact) RangeData
---@field ranges number[] [m] distances, one per scan angle; inf: nothing within reach, -inf: too near, nan: no reading (REP 117)
---@field geometry RangerGeometry where the ranger sits
---@field config RangerConfig what it can measure

---@class (exact) RangeData.Written
---@field ranges? number[] [m] distances, one per scan angle; inf: nothing within reach, -inf: too near, nan: no reading (REP 117)
---@field geometry? RangerGeometry.Written where the ranger sits
---@field config? RangerConfig.Written what it can measure

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
---@field width integer [px] of the pictures 0..65535
---@field height integer [px] 0..65535
---@field fx number [px] focal length in x; 0: unknown
---@field fy number [px] focal length along a column
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
---@field width? integer [px] of the pictures 0..65535
---@field height? integer [px] 0..65535
---@field fx? number [px] focal length in x; 0: unknown
---@field fy? number [px] focal length along a column
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
---@field id integer its number -2147483648..2147483647
---@field pose Pose3D from the camera: x forward, y left, z up

---@class (exact) SeenMarker.Written
---@field id? integer its number -2147483648..2147483647
---@field pose? Pose3D.Written from the camera: x forward, y left, z up

---@class (exact) builtin_interfaces.Duration
---@field sec integer [s] whole seconds -2147483648..2147483647
---@field nanosec integer [ns] the rest 0..4294967295

---@class (exact) builtin_interfaces.Duration.Written
---@field sec? integer [s] whole seconds -2147483648..2147483647
---@field nanosec? integer [ns] the rest 0..4294967295

---@class (exact) builtin_interfaces.Time
---@field sec integer [s] whole seconds -2147483648..2147483647
---@field nanosec integer [ns] the rest 0..4294967295

---@class (exact) builtin_interfaces.Time.Written
---@field sec? integer [s] whole seconds -2147483648..2147483647
---@field nanosec? integer [ns] the rest 0..4294967295

---@class (exact) geometry_msgs.Vector3
---@field x number
---@field y number
---@field z number

---@class (exact) geometry_msgs.Vector3.Written
---@field x? number
---@field y? number
---@field z? number

---@class (exact) geometry_msgs.Accel
---@field linear geometry_msgs.Vector3 [m/s^2]
---@field angular geometry_msgs.Vector3 [rad/s^2] about each axis

---@class (exact) geometry_msgs.Accel.Written
---@field linear? geometry_msgs.Vector3.Written [m/s^2]
---@field angular? geometry_msgs.Vector3.Written [rad/s^2] about each axis

---@class (exact) std_msgs.Header
---@field stamp builtin_interfaces.Time of the measurement
---@field frame_id string name of the frame

---@class (exact) std_msgs.Header.Written
---@field stamp? builtin_interfaces.Time.Written of the measurement
---@field frame_id? string name of the frame

---@class (exact) geometry_msgs.AccelStamped
---@field header std_msgs.Header when and in which frame
---@field accel geometry_msgs.Accel in that frame

---@class (exact) geometry_msgs.AccelStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field accel? geometry_msgs.Accel.Written in that frame

---@class (exact) geometry_msgs.AccelWithCovariance
---@field accel geometry_msgs.Accel the estimate
---@field covariance number[] 6 x 6, row by row: x, y, z, and the turns about them

---@class (exact) geometry_msgs.AccelWithCovariance.Written
---@field accel? geometry_msgs.Accel.Written the estimate
---@field covariance? number[] 6 x 6, row by row: x, y, z, and the turns about them

---@class (exact) geometry_msgs.AccelWithCovarianceStamped
---@field header std_msgs.Header when and in which frame
---@field accel geometry_msgs.AccelWithCovariance in that frame

---@class (exact) geometry_msgs.AccelWithCovarianceStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field accel? geometry_msgs.AccelWithCovariance.Written in that frame

---@class (exact) geometry_msgs.Inertia
---@field m number [kg]
---@field com geometry_msgs.Vector3 [m] the centre of mass
---@field ixx number [kg m^2] moments of inertia
---@field ixy number
---@field ixz number
---@field iyy number
---@field iyz number
---@field izz number

---@class (exact) geometry_msgs.Inertia.Written
---@field m? number [kg]
---@field com? geometry_msgs.Vector3.Written [m] the centre of mass
---@field ixx? number [kg m^2] moments of inertia
---@field ixy? number
---@field ixz? number
---@field iyy? number
---@field iyz? number
---@field izz? number

---@class (exact) geometry_msgs.InertiaStamped
---@field header std_msgs.Header when and in which frame
---@field inertia geometry_msgs.Inertia in that frame

---@class (exact) geometry_msgs.InertiaStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field inertia? geometry_msgs.Inertia.Written in that frame

---@class (exact) geometry_msgs.Point
---@field x number [m]
---@field y number [m]
---@field z number [m]

---@class (exact) geometry_msgs.Point.Written
---@field x? number [m]
---@field y? number [m]
---@field z? number [m]

---@class (exact) geometry_msgs.Point32
---@field x number [m]
---@field y number [m]
---@field z number [m]

---@class (exact) geometry_msgs.Point32.Written
---@field x? number [m]
---@field y? number [m]
---@field z? number [m]

---@class (exact) geometry_msgs.PointStamped
---@field header std_msgs.Header when and in which frame
---@field point geometry_msgs.Point in that frame

---@class (exact) geometry_msgs.PointStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field point? geometry_msgs.Point.Written in that frame

---@class (exact) geometry_msgs.Polygon
---@field points geometry_msgs.Point32[] its corners

---@class (exact) geometry_msgs.Polygon.Written
---@field points? geometry_msgs.Point32.Written[] its corners

---@class (exact) geometry_msgs.PolygonStamped
---@field header std_msgs.Header when and in which frame
---@field polygon geometry_msgs.Polygon in that frame

---@class (exact) geometry_msgs.PolygonStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field polygon? geometry_msgs.Polygon.Written in that frame

---@class (exact) geometry_msgs.Quaternion
---@field x number
---@field y number
---@field z number
---@field w number

---@class (exact) geometry_msgs.Quaternion.Written
---@field x? number
---@field y? number
---@field z? number
---@field w? number

---@class (exact) geometry_msgs.Pose
---@field position geometry_msgs.Point where
---@field orientation geometry_msgs.Quaternion which way

---@class (exact) geometry_msgs.Pose.Written
---@field position? geometry_msgs.Point.Written where
---@field orientation? geometry_msgs.Quaternion.Written which way

---@class (exact) geometry_msgs.Pose2D
---@field x number [m]
---@field y number [m]
---@field theta number [rad] counter-clockwise from the x axis

---@class (exact) geometry_msgs.Pose2D.Written
---@field x? number [m]
---@field y? number [m]
---@field theta? number [rad] counter-clockwise from the x axis

---@class (exact) geometry_msgs.PoseArray
---@field header std_msgs.Header when and in which frame
---@field poses geometry_msgs.Pose[] all of them

---@class (exact) geometry_msgs.PoseArray.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field poses? geometry_msgs.Pose.Written[] all of them

---@class (exact) geometry_msgs.PoseStamped
---@field header std_msgs.Header when and in which frame
---@field pose geometry_msgs.Pose in that frame

---@class (exact) geometry_msgs.PoseStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field pose? geometry_msgs.Pose.Written in that frame

---@class (exact) geometry_msgs.PoseWithCovariance
---@field pose geometry_msgs.Pose the estimate
---@field covariance number[] 6 x 6, row by row: x, y, z, and the turns about them

---@class (exact) geometry_msgs.PoseWithCovariance.Written
---@field pose? geometry_msgs.Pose.Written the estimate
---@field covariance? number[] 6 x 6, row by row: x, y, z, and the turns about them

---@class (exact) geometry_msgs.PoseWithCovarianceStamped
---@field header std_msgs.Header when and in which frame
---@field pose geometry_msgs.PoseWithCovariance in that frame

---@class (exact) geometry_msgs.PoseWithCovarianceStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field pose? geometry_msgs.PoseWithCovariance.Written in that frame

---@class (exact) geometry_msgs.QuaternionStamped
---@field header std_msgs.Header when and in which frame
---@field quaternion geometry_msgs.Quaternion in that frame

---@class (exact) geometry_msgs.QuaternionStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field quaternion? geometry_msgs.Quaternion.Written in that frame

---@class (exact) geometry_msgs.Transform
---@field translation geometry_msgs.Vector3 [m]
---@field rotation geometry_msgs.Quaternion which way

---@class (exact) geometry_msgs.Transform.Written
---@field translation? geometry_msgs.Vector3.Written [m]
---@field rotation? geometry_msgs.Quaternion.Written which way

---@class (exact) geometry_msgs.TransformStamped
---@field header std_msgs.Header when and in which frame
---@field child_frame_id string the frame that is placed
---@field transform geometry_msgs.Transform from the frame of the header to it

---@class (exact) geometry_msgs.TransformStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field child_frame_id? string the frame that is placed
---@field transform? geometry_msgs.Transform.Written from the frame of the header to it

---@class (exact) geometry_msgs.Twist
---@field linear geometry_msgs.Vector3 [m/s]
---@field angular geometry_msgs.Vector3 [rad/s] about each axis

---@class (exact) geometry_msgs.Twist.Written
---@field linear? geometry_msgs.Vector3.Written [m/s]
---@field angular? geometry_msgs.Vector3.Written [rad/s] about each axis

---@class (exact) geometry_msgs.TwistStamped
---@field header std_msgs.Header when and in which frame
---@field twist geometry_msgs.Twist in that frame

---@class (exact) geometry_msgs.TwistStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field twist? geometry_msgs.Twist.Written in that frame

---@class (exact) geometry_msgs.TwistWithCovariance
---@field twist geometry_msgs.Twist the estimate
---@field covariance number[] 6 x 6, row by row: x, y, z, and the turns about them

---@class (exact) geometry_msgs.TwistWithCovariance.Written
---@field twist? geometry_msgs.Twist.Written the estimate
---@field covariance? number[] 6 x 6, row by row: x, y, z, and the turns about them

---@class (exact) geometry_msgs.TwistWithCovarianceStamped
---@field header std_msgs.Header when and in which frame
---@field twist geometry_msgs.TwistWithCovariance in that frame

---@class (exact) geometry_msgs.TwistWithCovarianceStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field twist? geometry_msgs.TwistWithCovariance.Written in that frame

---@class (exact) geometry_msgs.Vector3Stamped
---@field header std_msgs.Header when and in which frame
---@field vector geometry_msgs.Vector3 in that frame

---@class (exact) geometry_msgs.Vector3Stamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field vector? geometry_msgs.Vector3.Written in that frame

---@class (exact) geometry_msgs.Wrench
---@field force geometry_msgs.Vector3 [N]
---@field torque geometry_msgs.Vector3 [Nm]

---@class (exact) geometry_msgs.Wrench.Written
---@field force? geometry_msgs.Vector3.Written [N]
---@field torque? geometry_msgs.Vector3.Written [Nm]

---@class (exact) geometry_msgs.WrenchStamped
---@field header std_msgs.Header when and in which frame
---@field wrench geometry_msgs.Wrench in that frame

---@class (exact) geometry_msgs.WrenchStamped.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field wrench? geometry_msgs.Wrench.Written in that frame

---@class (exact) nav_msgs.GridCells
---@field header std_msgs.Header when and in which frame
---@field cell_width number [m]
---@field cell_height number [m]
---@field cells geometry_msgs.Point[] their middles

---@class (exact) nav_msgs.GridCells.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field cell_width? number [m]
---@field cell_height? number [m]
---@field cells? geometry_msgs.Point.Written[] their middles

---@class (exact) nav_msgs.MapMetaData
---@field map_load_time builtin_interfaces.Time when it was loaded
---@field resolution number [m] side of a cell
---@field width integer cells along x 0..4294967295
---@field height integer cells along y 0..4294967295
---@field origin geometry_msgs.Pose of the corner of cell (0, 0)

---@class (exact) nav_msgs.MapMetaData.Written
---@field map_load_time? builtin_interfaces.Time.Written when it was loaded
---@field resolution? number [m] side of a cell
---@field width? integer cells along x 0..4294967295
---@field height? integer cells along y 0..4294967295
---@field origin? geometry_msgs.Pose.Written of the corner of cell (0, 0)

---@class (exact) nav_msgs.OccupancyGrid
---@field header std_msgs.Header when and in which frame
---@field info nav_msgs.MapMetaData what it covers
---@field data integer[] [%] row by row: 0 free, 100 occupied, -1 not known -128..127

---@class (exact) nav_msgs.OccupancyGrid.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field info? nav_msgs.MapMetaData.Written what it covers
---@field data? integer[] [%] row by row: 0 free, 100 occupied, -1 not known -128..127

---@class (exact) nav_msgs.Odometry
---@field header std_msgs.Header when and in which frame
---@field child_frame_id string frame of the velocity
---@field pose geometry_msgs.PoseWithCovariance in the frame of the header
---@field twist geometry_msgs.TwistWithCovariance in the frame of the robot

---@class (exact) nav_msgs.Odometry.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field child_frame_id? string frame of the velocity
---@field pose? geometry_msgs.PoseWithCovariance.Written in the frame of the header
---@field twist? geometry_msgs.TwistWithCovariance.Written in the frame of the robot

---@class (exact) nav_msgs.Path
---@field header std_msgs.Header when and in which frame
---@field poses geometry_msgs.PoseStamped[] in order

---@class (exact) nav_msgs.Path.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field poses? geometry_msgs.PoseStamped.Written[] in order

---@class (exact) raspimouse_msgs.Leds
---@field led0 boolean lit
---@field led1 boolean lit
---@field led2 boolean lit
---@field led3 boolean lit

---@class (exact) raspimouse_msgs.Leds.Written
---@field led0? boolean lit
---@field led1? boolean lit
---@field led2? boolean lit
---@field led3? boolean lit

---@class (exact) raspimouse_msgs.LightSensors
---@field forward_r integer right front -32768..32767
---@field forward_l integer left front -32768..32767
---@field left integer left side -32768..32767
---@field right integer right side -32768..32767

---@class (exact) raspimouse_msgs.LightSensors.Written
---@field forward_r? integer right front -32768..32767
---@field forward_l? integer left front -32768..32767
---@field left? integer left side -32768..32767
---@field right? integer right side -32768..32767

---@class (exact) raspimouse_msgs.Switches
---@field switch0 boolean pressed
---@field switch1 boolean pressed
---@field switch2 boolean pressed

---@class (exact) raspimouse_msgs.Switches.Written
---@field switch0? boolean pressed
---@field switch1? boolean pressed
---@field switch2? boolean pressed

---@class (exact) sensor_msgs.BatteryState
---@field header std_msgs.Header when and in which frame
---@field voltage number [V]
---@field temperature number [degC]
---@field current number [A] below 0 while it is discharged
---@field charge number [Ah] what is in it
---@field capacity number [Ah] what it held when it was full last
---@field design_capacity number [Ah] what it was made for
---@field percentage number from 0 to 1
---@field power_supply_status integer one of POWER_SUPPLY_STATUS_ 0..255
---@field power_supply_health integer one of POWER_SUPPLY_HEALTH_ 0..255
---@field power_supply_technology integer one of POWER_SUPPLY_TECHNOLOGY_ 0..255
---@field present boolean whether there is a battery
---@field cell_voltage number[] [V] of each cell
---@field cell_temperature number[] [degC] of each cell
---@field location string where it is put in
---@field serial_number string of the battery

---@class (exact) sensor_msgs.BatteryState.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field voltage? number [V]
---@field temperature? number [degC]
---@field current? number [A] below 0 while it is discharged
---@field charge? number [Ah] what is in it
---@field capacity? number [Ah] what it held when it was full last
---@field design_capacity? number [Ah] what it was made for
---@field percentage? number from 0 to 1
---@field power_supply_status? integer one of POWER_SUPPLY_STATUS_ 0..255
---@field power_supply_health? integer one of POWER_SUPPLY_HEALTH_ 0..255
---@field power_supply_technology? integer one of POWER_SUPPLY_TECHNOLOGY_ 0..255
---@field present? boolean whether there is a battery
---@field cell_voltage? number[] [V] of each cell
---@field cell_temperature? number[] [degC] of each cell
---@field location? string where it is put in
---@field serial_number? string of the battery

---@class (exact) sensor_msgs.RegionOfInterest
---@field x_offset integer [px] of its left edge 0..4294967295
---@field y_offset integer [px] of its upper edge 0..4294967295
---@field height integer [px] 0: the whole picture 0..4294967295
---@field width integer [px] 0: the whole picture 0..4294967295
---@field do_rectify boolean whether it is to be rectified

---@class (exact) sensor_msgs.RegionOfInterest.Written
---@field x_offset? integer [px] of its left edge 0..4294967295
---@field y_offset? integer [px] of its upper edge 0..4294967295
---@field height? integer [px] 0: the whole picture 0..4294967295
---@field width? integer [px] 0: the whole picture 0..4294967295
---@field do_rectify? boolean whether it is to be rectified

---@class (exact) sensor_msgs.CameraInfo
---@field header std_msgs.Header when and in which frame
---@field height integer [px] of the pictures 0..4294967295
---@field width integer [px] of the pictures 0..4294967295
---@field distortion_model string "plumb_bob", "rational_polynomial", ...
---@field d number[] distortion, as the model counts it
---@field k number[] 3 x 3, row by row: focal lengths and optical axis [px]
---@field r number[] 3 x 3: turns the camera for stereo
---@field p number[] 3 x 4: projection of the rectified picture
---@field binning_x integer camera pixels in a pixel, along a row 0..4294967295
---@field binning_y integer the same along a column 0..4294967295
---@field roi sensor_msgs.RegionOfInterest of the whole picture of the camera

---@class (exact) sensor_msgs.CameraInfo.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field height? integer [px] of the pictures 0..4294967295
---@field width? integer [px] of the pictures 0..4294967295
---@field distortion_model? string "plumb_bob", "rational_polynomial", ...
---@field d? number[] distortion, as the model counts it
---@field k? number[] 3 x 3, row by row: focal lengths and optical axis [px]
---@field r? number[] 3 x 3: turns the camera for stereo
---@field p? number[] 3 x 4: projection of the rectified picture
---@field binning_x? integer camera pixels in a pixel, along a row 0..4294967295
---@field binning_y? integer the same along a column 0..4294967295
---@field roi? sensor_msgs.RegionOfInterest.Written of the whole picture of the camera

---@class (exact) sensor_msgs.ChannelFloat32
---@field name string what it is
---@field values number[] one for each point

---@class (exact) sensor_msgs.ChannelFloat32.Written
---@field name? string what it is
---@field values? number[] one for each point

---@class (exact) sensor_msgs.CompressedImage
---@field header std_msgs.Header when and in which frame
---@field format string "jpeg", "png", ...
---@field data string the bytes of the file

---@class (exact) sensor_msgs.CompressedImage.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field format? string "jpeg", "png", ...
---@field data? string the bytes of the file

---@class (exact) sensor_msgs.FluidPressure
---@field header std_msgs.Header when and in which frame
---@field fluid_pressure number [Pa]
---@field variance number 0: not known

---@class (exact) sensor_msgs.FluidPressure.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field fluid_pressure? number [Pa]
---@field variance? number 0: not known

---@class (exact) sensor_msgs.Illuminance
---@field header std_msgs.Header when and in which frame
---@field illuminance number [lx]
---@field variance number 0: not known

---@class (exact) sensor_msgs.Illuminance.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field illuminance? number [lx]
---@field variance? number 0: not known

---@class (exact) sensor_msgs.Image
---@field header std_msgs.Header when and in which frame
---@field height integer [px] 0..4294967295
---@field width integer [px] 0..4294967295
---@field encoding string "rgb8", "mono8", ...
---@field is_bigendian integer of numbers of several bytes: 1 if the highest comes first 0..255
---@field step integer [bytes] of a row 0..4294967295
---@field data string row by row from the top left

---@class (exact) sensor_msgs.Image.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field height? integer [px] 0..4294967295
---@field width? integer [px] 0..4294967295
---@field encoding? string "rgb8", "mono8", ...
---@field is_bigendian? integer of numbers of several bytes: 1 if the highest comes first 0..255
---@field step? integer [bytes] of a row 0..4294967295
---@field data? string row by row from the top left

---@class (exact) sensor_msgs.Imu
---@field header std_msgs.Header when and in which frame
---@field orientation geometry_msgs.Quaternion
---@field orientation_covariance number[] 3 x 3, row by row
---@field angular_velocity geometry_msgs.Vector3 [rad/s]
---@field angular_velocity_covariance number[] 3 x 3, row by row
---@field linear_acceleration geometry_msgs.Vector3 [m/s^2]
---@field linear_acceleration_covariance number[] 3 x 3, row by row

---@class (exact) sensor_msgs.Imu.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field orientation? geometry_msgs.Quaternion.Written
---@field orientation_covariance? number[] 3 x 3, row by row
---@field angular_velocity? geometry_msgs.Vector3.Written [rad/s]
---@field angular_velocity_covariance? number[] 3 x 3, row by row
---@field linear_acceleration? geometry_msgs.Vector3.Written [m/s^2]
---@field linear_acceleration_covariance? number[] 3 x 3, row by row

---@class (exact) sensor_msgs.JointState
---@field header std_msgs.Header when and in which frame
---@field name string[] of each joint
---@field position number[] [rad] or [m]
---@field velocity number[] [rad/s] or [m/s]
---@field effort number[] [Nm] or [N]

---@class (exact) sensor_msgs.JointState.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field name? string[] of each joint
---@field position? number[] [rad] or [m]
---@field velocity? number[] [rad/s] or [m/s]
---@field effort? number[] [Nm] or [N]

---@class (exact) sensor_msgs.Joy
---@field header std_msgs.Header when and in which frame
---@field axes number[] from -1 to 1
---@field buttons integer[] 1 while pressed -2147483648..2147483647

---@class (exact) sensor_msgs.Joy.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field axes? number[] from -1 to 1
---@field buttons? integer[] 1 while pressed -2147483648..2147483647

---@class (exact) sensor_msgs.JoyFeedback
---@field type integer one of TYPE_ 0..255
---@field id integer which of its kind 0..255
---@field intensity number from 0 to 1

---@class (exact) sensor_msgs.JoyFeedback.Written
---@field type? integer one of TYPE_ 0..255
---@field id? integer which of its kind 0..255
---@field intensity? number from 0 to 1

---@class (exact) sensor_msgs.JoyFeedbackArray
---@field array sensor_msgs.JoyFeedback[] all of them

---@class (exact) sensor_msgs.JoyFeedbackArray.Written
---@field array? sensor_msgs.JoyFeedback.Written[] all of them

---@class (exact) sensor_msgs.LaserEcho
---@field echoes number[] [m] or intensities

---@class (exact) sensor_msgs.LaserEcho.Written
---@field echoes? number[] [m] or intensities

---@class (exact) sensor_msgs.LaserScan
---@field header std_msgs.Header when and in which frame
---@field angle_min number [rad] of the first ray
---@field angle_max number [rad] of the last ray
---@field angle_increment number [rad] from ray to ray
---@field time_increment number [s] from ray to ray
---@field scan_time number [s] from scan to scan
---@field range_min number [m] nearer is not measured
---@field range_max number [m] farther is not measured
---@field ranges number[] [m] one for each ray
---@field intensities number[] one for each ray, or none

---@class (exact) sensor_msgs.LaserScan.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field angle_min? number [rad] of the first ray
---@field angle_max? number [rad] of the last ray
---@field angle_increment? number [rad] from ray to ray
---@field time_increment? number [s] from ray to ray
---@field scan_time? number [s] from scan to scan
---@field range_min? number [m] nearer is not measured
---@field range_max? number [m] farther is not measured
---@field ranges? number[] [m] one for each ray
---@field intensities? number[] one for each ray, or none

---@class (exact) sensor_msgs.MagneticField
---@field header std_msgs.Header when and in which frame
---@field magnetic_field geometry_msgs.Vector3 [T]
---@field magnetic_field_covariance number[] 3 x 3, row by row; 0: not known

---@class (exact) sensor_msgs.MagneticField.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field magnetic_field? geometry_msgs.Vector3.Written [T]
---@field magnetic_field_covariance? number[] 3 x 3, row by row; 0: not known

---@class (exact) sensor_msgs.MultiDOFJointState
---@field header std_msgs.Header when and in which frame
---@field joint_names string[] of each joint
---@field transforms geometry_msgs.Transform[] where it is
---@field twist geometry_msgs.Twist[] how fast it moves
---@field wrench geometry_msgs.Wrench[] what acts on it

---@class (exact) sensor_msgs.MultiDOFJointState.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field joint_names? string[] of each joint
---@field transforms? geometry_msgs.Transform.Written[] where it is
---@field twist? geometry_msgs.Twist.Written[] how fast it moves
---@field wrench? geometry_msgs.Wrench.Written[] what acts on it

---@class (exact) sensor_msgs.MultiEchoLaserScan
---@field header std_msgs.Header when and in which frame
---@field angle_min number [rad] of the first ray
---@field angle_max number [rad] of the last ray
---@field angle_increment number [rad] from ray to ray
---@field time_increment number [s] from ray to ray
---@field scan_time number [s] from scan to scan
---@field range_min number [m] nearer is not measured
---@field range_max number [m] farther is not measured
---@field ranges sensor_msgs.LaserEcho[] [m] of each ray
---@field intensities sensor_msgs.LaserEcho[] of each ray, or none

---@class (exact) sensor_msgs.MultiEchoLaserScan.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field angle_min? number [rad] of the first ray
---@field angle_max? number [rad] of the last ray
---@field angle_increment? number [rad] from ray to ray
---@field time_increment? number [s] from ray to ray
---@field scan_time? number [s] from scan to scan
---@field range_min? number [m] nearer is not measured
---@field range_max? number [m] farther is not measured
---@field ranges? sensor_msgs.LaserEcho.Written[] [m] of each ray
---@field intensities? sensor_msgs.LaserEcho.Written[] of each ray, or none

---@class (exact) sensor_msgs.NavSatStatus
---@field status integer one of STATUS_ -128..127
---@field service integer a sum of SERVICE_ 0..65535

---@class (exact) sensor_msgs.NavSatStatus.Written
---@field status? integer one of STATUS_ -128..127
---@field service? integer a sum of SERVICE_ 0..65535

---@class (exact) sensor_msgs.NavSatFix
---@field header std_msgs.Header when and in which frame
---@field status sensor_msgs.NavSatStatus
---@field latitude number [deg] north of the equator
---@field longitude number [deg] east of Greenwich
---@field altitude number [m] above the ellipsoid
---@field position_covariance number[] [m^2] 3 x 3, row by row: east, north, up
---@field position_covariance_type integer one of COVARIANCE_TYPE_ 0..255

---@class (exact) sensor_msgs.NavSatFix.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field status? sensor_msgs.NavSatStatus.Written
---@field latitude? number [deg] north of the equator
---@field longitude? number [deg] east of Greenwich
---@field altitude? number [m] above the ellipsoid
---@field position_covariance? number[] [m^2] 3 x 3, row by row: east, north, up
---@field position_covariance_type? integer one of COVARIANCE_TYPE_ 0..255

---@class (exact) sensor_msgs.PointCloud
---@field header std_msgs.Header when and in which frame
---@field points geometry_msgs.Point32[] all of them
---@field channels sensor_msgs.ChannelFloat32[] what else is known of each

---@class (exact) sensor_msgs.PointCloud.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field points? geometry_msgs.Point32.Written[] all of them
---@field channels? sensor_msgs.ChannelFloat32.Written[] what else is known of each

---@class (exact) sensor_msgs.PointField
---@field name string "x", "y", "z", "rgb", ...
---@field offset integer [bytes] from the begin of the point 0..4294967295
---@field datatype integer one of the constants 0..255
---@field count integer how many numbers 0..4294967295

---@class (exact) sensor_msgs.PointField.Written
---@field name? string "x", "y", "z", "rgb", ...
---@field offset? integer [bytes] from the begin of the point 0..4294967295
---@field datatype? integer one of the constants 0..255
---@field count? integer how many numbers 0..4294967295

---@class (exact) sensor_msgs.PointCloud2
---@field header std_msgs.Header when and in which frame
---@field height integer rows; 1: in no order 0..4294967295
---@field width integer points in a row 0..4294967295
---@field fields sensor_msgs.PointField[] of a point
---@field is_bigendian boolean
---@field point_step integer [bytes] of a point 0..4294967295
---@field row_step integer [bytes] of a row 0..4294967295
---@field data string all points
---@field is_dense boolean whether none is invalid

---@class (exact) sensor_msgs.PointCloud2.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field height? integer rows; 1: in no order 0..4294967295
---@field width? integer points in a row 0..4294967295
---@field fields? sensor_msgs.PointField.Written[] of a point
---@field is_bigendian? boolean
---@field point_step? integer [bytes] of a point 0..4294967295
---@field row_step? integer [bytes] of a row 0..4294967295
---@field data? string all points
---@field is_dense? boolean whether none is invalid

---@class (exact) sensor_msgs.Range
---@field header std_msgs.Header when and in which frame
---@field radiation_type integer ULTRASOUND or INFRARED 0..255
---@field field_of_view number [rad] the angle of the cone
---@field min_range number [m] nearer is not measured
---@field max_range number [m] farther is not measured
---@field range number [m]
---@field variance number [m^2] 0: not known

---@class (exact) sensor_msgs.Range.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field radiation_type? integer ULTRASOUND or INFRARED 0..255
---@field field_of_view? number [rad] the angle of the cone
---@field min_range? number [m] nearer is not measured
---@field max_range? number [m] farther is not measured
---@field range? number [m]
---@field variance? number [m^2] 0: not known

---@class (exact) sensor_msgs.RelativeHumidity
---@field header std_msgs.Header when and in which frame
---@field relative_humidity number from 0 to 1
---@field variance number 0: not known

---@class (exact) sensor_msgs.RelativeHumidity.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field relative_humidity? number from 0 to 1
---@field variance? number 0: not known

---@class (exact) sensor_msgs.Temperature
---@field header std_msgs.Header when and in which frame
---@field temperature number [degC]
---@field variance number 0: not known

---@class (exact) sensor_msgs.Temperature.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field temperature? number [degC]
---@field variance? number 0: not known

---@class (exact) sensor_msgs.TimeReference
---@field header std_msgs.Header when and in which frame
---@field time_ref builtin_interfaces.Time what that clock says
---@field source string its name

---@class (exact) sensor_msgs.TimeReference.Written
---@field header? std_msgs.Header.Written when and in which frame
---@field time_ref? builtin_interfaces.Time.Written what that clock says
---@field source? string its name

---@class (exact) std_msgs.Bool
---@field data boolean

---@class (exact) std_msgs.Bool.Written
---@field data? boolean

---@class (exact) std_msgs.Byte
---@field data integer 0..255

---@class (exact) std_msgs.Byte.Written
---@field data? integer 0..255

---@class (exact) std_msgs.MultiArrayDimension
---@field label string its name
---@field size integer elements along it 0..4294967295
---@field stride integer elements from one step along it to the next, times its size 0..4294967295

---@class (exact) std_msgs.MultiArrayDimension.Written
---@field label? string its name
---@field size? integer elements along it 0..4294967295
---@field stride? integer elements from one step along it to the next, times its size 0..4294967295

---@class (exact) std_msgs.MultiArrayLayout
---@field dim std_msgs.MultiArrayDimension[] from the outermost inwards
---@field data_offset integer elements before the first 0..4294967295

---@class (exact) std_msgs.MultiArrayLayout.Written
---@field dim? std_msgs.MultiArrayDimension.Written[] from the outermost inwards
---@field data_offset? integer elements before the first 0..4294967295

---@class (exact) std_msgs.ByteMultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data string all elements

---@class (exact) std_msgs.ByteMultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? string all elements

---@class (exact) std_msgs.Char
---@field data integer 0..255

---@class (exact) std_msgs.Char.Written
---@field data? integer 0..255

---@class (exact) std_msgs.ColorRGBA
---@field r number red
---@field g number green
---@field b number blue
---@field a number opacity

---@class (exact) std_msgs.ColorRGBA.Written
---@field r? number red
---@field g? number green
---@field b? number blue
---@field a? number opacity

---@class (exact) std_msgs.Empty

---@class (exact) std_msgs.Empty.Written

---@class (exact) std_msgs.Float32
---@field data number

---@class (exact) std_msgs.Float32.Written
---@field data? number

---@class (exact) std_msgs.Float32MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data number[] all elements

---@class (exact) std_msgs.Float32MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? number[] all elements

---@class (exact) std_msgs.Float64
---@field data number

---@class (exact) std_msgs.Float64.Written
---@field data? number

---@class (exact) std_msgs.Float64MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data number[] all elements

---@class (exact) std_msgs.Float64MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? number[] all elements

---@class (exact) std_msgs.Int16
---@field data integer -32768..32767

---@class (exact) std_msgs.Int16.Written
---@field data? integer -32768..32767

---@class (exact) std_msgs.Int16MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data integer[] all elements -32768..32767

---@class (exact) std_msgs.Int16MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? integer[] all elements -32768..32767

---@class (exact) std_msgs.Int32
---@field data integer -2147483648..2147483647

---@class (exact) std_msgs.Int32.Written
---@field data? integer -2147483648..2147483647

---@class (exact) std_msgs.Int32MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data integer[] all elements -2147483648..2147483647

---@class (exact) std_msgs.Int32MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? integer[] all elements -2147483648..2147483647

---@class (exact) std_msgs.Int64
---@field data integer -9223372036854775808..9223372036854775807

---@class (exact) std_msgs.Int64.Written
---@field data? integer -9223372036854775808..9223372036854775807

---@class (exact) std_msgs.Int64MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data integer[] all elements -9223372036854775808..9223372036854775807

---@class (exact) std_msgs.Int64MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? integer[] all elements -9223372036854775808..9223372036854775807

---@class (exact) std_msgs.Int8
---@field data integer -128..127

---@class (exact) std_msgs.Int8.Written
---@field data? integer -128..127

---@class (exact) std_msgs.Int8MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data integer[] all elements -128..127

---@class (exact) std_msgs.Int8MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? integer[] all elements -128..127

---@class (exact) std_msgs.String
---@field data string

---@class (exact) std_msgs.String.Written
---@field data? string

---@class (exact) std_msgs.UInt16
---@field data integer 0..65535

---@class (exact) std_msgs.UInt16.Written
---@field data? integer 0..65535

---@class (exact) std_msgs.UInt16MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data integer[] all elements 0..65535

---@class (exact) std_msgs.UInt16MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? integer[] all elements 0..65535

---@class (exact) std_msgs.UInt32
---@field data integer 0..4294967295

---@class (exact) std_msgs.UInt32.Written
---@field data? integer 0..4294967295

---@class (exact) std_msgs.UInt32MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data integer[] all elements 0..4294967295

---@class (exact) std_msgs.UInt32MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? integer[] all elements 0..4294967295

---@class (exact) std_msgs.UInt64
---@field data integer 0..9223372036854775807

---@class (exact) std_msgs.UInt64.Written
---@field data? integer 0..9223372036854775807

---@class (exact) std_msgs.UInt64MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data integer[] all elements 0..9223372036854775807

---@class (exact) std_msgs.UInt64MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? integer[] all elements 0..9223372036854775807

---@class (exact) std_msgs.UInt8
---@field data integer 0..255

---@class (exact) std_msgs.UInt8.Written
---@field data? integer 0..255

---@class (exact) std_msgs.UInt8MultiArray
---@field layout std_msgs.MultiArrayLayout how the elements are ordered
---@field data string all elements

---@class (exact) std_msgs.UInt8MultiArray.Written
---@field layout? std_msgs.MultiArrayLayout.Written how the elements are ordered
---@field data? string all elements

---@class InPort
---@field is_new boolean there is an unread message
---@field tm number [s] stamp of the value, 0 before the first message
---@field age number [s] now() - tm, math.huge before the first message
---@field connected boolean
---@field stale boolean no message came for three periods of its sender, or none can come

---@class OutPort

---An in-port of TimedBoolean: one truth value.
---@class TimedBoolean.In : InPort
---@field read fun(self: TimedBoolean.In): boolean

---An out-port of TimedBoolean: one truth value.
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

---An in-port of TimedString: one text.
---@class TimedString.In : InPort
---@field read fun(self: TimedString.In): string

---An out-port of TimedString: one text.
---@class TimedString.Out : OutPort
---@field write fun(self: TimedString.Out, value: string)

---@class (exact) TimedString.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedString.OutOptions
---@field safe? string written when the component stops

---An in-port of TimedBooleanSeq: a sequence of truth values.
---@class TimedBooleanSeq.In : InPort
---@field read fun(self: TimedBooleanSeq.In): boolean[]

---An out-port of TimedBooleanSeq: a sequence of truth values.
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

---An in-port of TimedStringSeq: a sequence of texts.
---@class TimedStringSeq.In : InPort
---@field read fun(self: TimedStringSeq.In): string[]

---An out-port of TimedStringSeq: a sequence of texts.
---@class TimedStringSeq.Out : OutPort
---@field write fun(self: TimedStringSeq.Out, value: string[])

---@class (exact) TimedStringSeq.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) TimedStringSeq.OutOptions
---@field safe? string[] written when the component stops

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

---An in-port of builtin_interfaces.Duration: A span of time..
---@class builtin_interfaces.Duration.In : InPort
---@field read fun(self: builtin_interfaces.Duration.In): builtin_interfaces.Duration

---An out-port of builtin_interfaces.Duration: A span of time..
---@class builtin_interfaces.Duration.Out : OutPort
---@field write fun(self: builtin_interfaces.Duration.Out, value: builtin_interfaces.Duration.Written)

---@class (exact) builtin_interfaces.Duration.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) builtin_interfaces.Duration.OutOptions
---@field safe? builtin_interfaces.Duration.Written written when the component stops

---An in-port of builtin_interfaces.Time: A point in time, from the epoch of the clock..
---@class builtin_interfaces.Time.In : InPort
---@field read fun(self: builtin_interfaces.Time.In): builtin_interfaces.Time

---An out-port of builtin_interfaces.Time: A point in time, from the epoch of the clock..
---@class builtin_interfaces.Time.Out : OutPort
---@field write fun(self: builtin_interfaces.Time.Out, value: builtin_interfaces.Time.Written)

---@class (exact) builtin_interfaces.Time.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) builtin_interfaces.Time.OutOptions
---@field safe? builtin_interfaces.Time.Written written when the component stops

---An in-port of geometry_msgs.Accel: An acceleration and a change of the rate of turn..
---@class geometry_msgs.Accel.In : InPort
---@field read fun(self: geometry_msgs.Accel.In): geometry_msgs.Accel

---An out-port of geometry_msgs.Accel: An acceleration and a change of the rate of turn..
---@class geometry_msgs.Accel.Out : OutPort
---@field write fun(self: geometry_msgs.Accel.Out, value: geometry_msgs.Accel.Written)

---@class (exact) geometry_msgs.Accel.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Accel.OutOptions
---@field safe? geometry_msgs.Accel.Written written when the component stops

---An in-port of geometry_msgs.AccelStamped: A Accel with its time and frame..
---@class geometry_msgs.AccelStamped.In : InPort
---@field read fun(self: geometry_msgs.AccelStamped.In): geometry_msgs.AccelStamped

---An out-port of geometry_msgs.AccelStamped: A Accel with its time and frame..
---@class geometry_msgs.AccelStamped.Out : OutPort
---@field write fun(self: geometry_msgs.AccelStamped.Out, value: geometry_msgs.AccelStamped.Written)

---@class (exact) geometry_msgs.AccelStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.AccelStamped.OutOptions
---@field safe? geometry_msgs.AccelStamped.Written written when the component stops

---An in-port of geometry_msgs.AccelWithCovariance: A Accel and how sure it is..
---@class geometry_msgs.AccelWithCovariance.In : InPort
---@field read fun(self: geometry_msgs.AccelWithCovariance.In): geometry_msgs.AccelWithCovariance

---An out-port of geometry_msgs.AccelWithCovariance: A Accel and how sure it is..
---@class geometry_msgs.AccelWithCovariance.Out : OutPort
---@field write fun(self: geometry_msgs.AccelWithCovariance.Out, value: geometry_msgs.AccelWithCovariance.Written)

---@class (exact) geometry_msgs.AccelWithCovariance.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.AccelWithCovariance.OutOptions
---@field safe? geometry_msgs.AccelWithCovariance.Written written when the component stops

---An in-port of geometry_msgs.AccelWithCovarianceStamped: A AccelWithCovariance with its time and frame..
---@class geometry_msgs.AccelWithCovarianceStamped.In : InPort
---@field read fun(self: geometry_msgs.AccelWithCovarianceStamped.In): geometry_msgs.AccelWithCovarianceStamped

---An out-port of geometry_msgs.AccelWithCovarianceStamped: A AccelWithCovariance with its time and frame..
---@class geometry_msgs.AccelWithCovarianceStamped.Out : OutPort
---@field write fun(self: geometry_msgs.AccelWithCovarianceStamped.Out, value: geometry_msgs.AccelWithCovarianceStamped.Written)

---@class (exact) geometry_msgs.AccelWithCovarianceStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.AccelWithCovarianceStamped.OutOptions
---@field safe? geometry_msgs.AccelWithCovarianceStamped.Written written when the component stops

---An in-port of geometry_msgs.Inertia: The mass of a body and how it is spread..
---@class geometry_msgs.Inertia.In : InPort
---@field read fun(self: geometry_msgs.Inertia.In): geometry_msgs.Inertia

---An out-port of geometry_msgs.Inertia: The mass of a body and how it is spread..
---@class geometry_msgs.Inertia.Out : OutPort
---@field write fun(self: geometry_msgs.Inertia.Out, value: geometry_msgs.Inertia.Written)

---@class (exact) geometry_msgs.Inertia.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Inertia.OutOptions
---@field safe? geometry_msgs.Inertia.Written written when the component stops

---An in-port of geometry_msgs.InertiaStamped: A Inertia with its time and frame..
---@class geometry_msgs.InertiaStamped.In : InPort
---@field read fun(self: geometry_msgs.InertiaStamped.In): geometry_msgs.InertiaStamped

---An out-port of geometry_msgs.InertiaStamped: A Inertia with its time and frame..
---@class geometry_msgs.InertiaStamped.Out : OutPort
---@field write fun(self: geometry_msgs.InertiaStamped.Out, value: geometry_msgs.InertiaStamped.Written)

---@class (exact) geometry_msgs.InertiaStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.InertiaStamped.OutOptions
---@field safe? geometry_msgs.InertiaStamped.Written written when the component stops

---An in-port of geometry_msgs.Point: A place in space..
---@class geometry_msgs.Point.In : InPort
---@field read fun(self: geometry_msgs.Point.In): geometry_msgs.Point

---An out-port of geometry_msgs.Point: A place in space..
---@class geometry_msgs.Point.Out : OutPort
---@field write fun(self: geometry_msgs.Point.Out, value: geometry_msgs.Point.Written)

---@class (exact) geometry_msgs.Point.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Point.OutOptions
---@field safe? geometry_msgs.Point.Written written when the component stops

---An in-port of geometry_msgs.Point32: A place in space, as smaller numbers..
---@class geometry_msgs.Point32.In : InPort
---@field read fun(self: geometry_msgs.Point32.In): geometry_msgs.Point32

---An out-port of geometry_msgs.Point32: A place in space, as smaller numbers..
---@class geometry_msgs.Point32.Out : OutPort
---@field write fun(self: geometry_msgs.Point32.Out, value: geometry_msgs.Point32.Written)

---@class (exact) geometry_msgs.Point32.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Point32.OutOptions
---@field safe? geometry_msgs.Point32.Written written when the component stops

---An in-port of geometry_msgs.PointStamped: A Point with its time and frame..
---@class geometry_msgs.PointStamped.In : InPort
---@field read fun(self: geometry_msgs.PointStamped.In): geometry_msgs.PointStamped

---An out-port of geometry_msgs.PointStamped: A Point with its time and frame..
---@class geometry_msgs.PointStamped.Out : OutPort
---@field write fun(self: geometry_msgs.PointStamped.Out, value: geometry_msgs.PointStamped.Written)

---@class (exact) geometry_msgs.PointStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.PointStamped.OutOptions
---@field safe? geometry_msgs.PointStamped.Written written when the component stops

---An in-port of geometry_msgs.Polygon: A closed line; the last point is joined to the first..
---@class geometry_msgs.Polygon.In : InPort
---@field read fun(self: geometry_msgs.Polygon.In): geometry_msgs.Polygon

---An out-port of geometry_msgs.Polygon: A closed line; the last point is joined to the first..
---@class geometry_msgs.Polygon.Out : OutPort
---@field write fun(self: geometry_msgs.Polygon.Out, value: geometry_msgs.Polygon.Written)

---@class (exact) geometry_msgs.Polygon.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Polygon.OutOptions
---@field safe? geometry_msgs.Polygon.Written written when the component stops

---An in-port of geometry_msgs.PolygonStamped: A Polygon with its time and frame..
---@class geometry_msgs.PolygonStamped.In : InPort
---@field read fun(self: geometry_msgs.PolygonStamped.In): geometry_msgs.PolygonStamped

---An out-port of geometry_msgs.PolygonStamped: A Polygon with its time and frame..
---@class geometry_msgs.PolygonStamped.Out : OutPort
---@field write fun(self: geometry_msgs.PolygonStamped.Out, value: geometry_msgs.PolygonStamped.Written)

---@class (exact) geometry_msgs.PolygonStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.PolygonStamped.OutOptions
---@field safe? geometry_msgs.PolygonStamped.Written written when the component stops

---An in-port of geometry_msgs.Pose: A place and an orientation in space..
---@class geometry_msgs.Pose.In : InPort
---@field read fun(self: geometry_msgs.Pose.In): geometry_msgs.Pose

---An out-port of geometry_msgs.Pose: A place and an orientation in space..
---@class geometry_msgs.Pose.Out : OutPort
---@field write fun(self: geometry_msgs.Pose.Out, value: geometry_msgs.Pose.Written)

---@class (exact) geometry_msgs.Pose.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Pose.OutOptions
---@field safe? geometry_msgs.Pose.Written written when the component stops

---An in-port of geometry_msgs.Pose2D: A place and a heading on the floor..
---@class geometry_msgs.Pose2D.In : InPort
---@field read fun(self: geometry_msgs.Pose2D.In): geometry_msgs.Pose2D

---An out-port of geometry_msgs.Pose2D: A place and a heading on the floor..
---@class geometry_msgs.Pose2D.Out : OutPort
---@field write fun(self: geometry_msgs.Pose2D.Out, value: geometry_msgs.Pose2D.Written)

---@class (exact) geometry_msgs.Pose2D.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Pose2D.OutOptions
---@field safe? geometry_msgs.Pose2D.Written written when the component stops

---An in-port of geometry_msgs.PoseArray: Several poses in one frame..
---@class geometry_msgs.PoseArray.In : InPort
---@field read fun(self: geometry_msgs.PoseArray.In): geometry_msgs.PoseArray

---An out-port of geometry_msgs.PoseArray: Several poses in one frame..
---@class geometry_msgs.PoseArray.Out : OutPort
---@field write fun(self: geometry_msgs.PoseArray.Out, value: geometry_msgs.PoseArray.Written)

---@class (exact) geometry_msgs.PoseArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.PoseArray.OutOptions
---@field safe? geometry_msgs.PoseArray.Written written when the component stops

---An in-port of geometry_msgs.PoseStamped: A Pose with its time and frame..
---@class geometry_msgs.PoseStamped.In : InPort
---@field read fun(self: geometry_msgs.PoseStamped.In): geometry_msgs.PoseStamped

---An out-port of geometry_msgs.PoseStamped: A Pose with its time and frame..
---@class geometry_msgs.PoseStamped.Out : OutPort
---@field write fun(self: geometry_msgs.PoseStamped.Out, value: geometry_msgs.PoseStamped.Written)

---@class (exact) geometry_msgs.PoseStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.PoseStamped.OutOptions
---@field safe? geometry_msgs.PoseStamped.Written written when the component stops

---An in-port of geometry_msgs.PoseWithCovariance: A Pose and how sure it is..
---@class geometry_msgs.PoseWithCovariance.In : InPort
---@field read fun(self: geometry_msgs.PoseWithCovariance.In): geometry_msgs.PoseWithCovariance

---An out-port of geometry_msgs.PoseWithCovariance: A Pose and how sure it is..
---@class geometry_msgs.PoseWithCovariance.Out : OutPort
---@field write fun(self: geometry_msgs.PoseWithCovariance.Out, value: geometry_msgs.PoseWithCovariance.Written)

---@class (exact) geometry_msgs.PoseWithCovariance.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.PoseWithCovariance.OutOptions
---@field safe? geometry_msgs.PoseWithCovariance.Written written when the component stops

---An in-port of geometry_msgs.PoseWithCovarianceStamped: A PoseWithCovariance with its time and frame..
---@class geometry_msgs.PoseWithCovarianceStamped.In : InPort
---@field read fun(self: geometry_msgs.PoseWithCovarianceStamped.In): geometry_msgs.PoseWithCovarianceStamped

---An out-port of geometry_msgs.PoseWithCovarianceStamped: A PoseWithCovariance with its time and frame..
---@class geometry_msgs.PoseWithCovarianceStamped.Out : OutPort
---@field write fun(self: geometry_msgs.PoseWithCovarianceStamped.Out, value: geometry_msgs.PoseWithCovarianceStamped.Written)

---@class (exact) geometry_msgs.PoseWithCovarianceStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.PoseWithCovarianceStamped.OutOptions
---@field safe? geometry_msgs.PoseWithCovarianceStamped.Written written when the component stops

---An in-port of geometry_msgs.Quaternion: An orientation in space; by itself no turn..
---@class geometry_msgs.Quaternion.In : InPort
---@field read fun(self: geometry_msgs.Quaternion.In): geometry_msgs.Quaternion

---An out-port of geometry_msgs.Quaternion: An orientation in space; by itself no turn..
---@class geometry_msgs.Quaternion.Out : OutPort
---@field write fun(self: geometry_msgs.Quaternion.Out, value: geometry_msgs.Quaternion.Written)

---@class (exact) geometry_msgs.Quaternion.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Quaternion.OutOptions
---@field safe? geometry_msgs.Quaternion.Written written when the component stops

---An in-port of geometry_msgs.QuaternionStamped: A Quaternion with its time and frame..
---@class geometry_msgs.QuaternionStamped.In : InPort
---@field read fun(self: geometry_msgs.QuaternionStamped.In): geometry_msgs.QuaternionStamped

---An out-port of geometry_msgs.QuaternionStamped: A Quaternion with its time and frame..
---@class geometry_msgs.QuaternionStamped.Out : OutPort
---@field write fun(self: geometry_msgs.QuaternionStamped.Out, value: geometry_msgs.QuaternionStamped.Written)

---@class (exact) geometry_msgs.QuaternionStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.QuaternionStamped.OutOptions
---@field safe? geometry_msgs.QuaternionStamped.Written written when the component stops

---An in-port of geometry_msgs.Transform: From one frame to another..
---@class geometry_msgs.Transform.In : InPort
---@field read fun(self: geometry_msgs.Transform.In): geometry_msgs.Transform

---An out-port of geometry_msgs.Transform: From one frame to another..
---@class geometry_msgs.Transform.Out : OutPort
---@field write fun(self: geometry_msgs.Transform.Out, value: geometry_msgs.Transform.Written)

---@class (exact) geometry_msgs.Transform.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Transform.OutOptions
---@field safe? geometry_msgs.Transform.Written written when the component stops

---An in-port of geometry_msgs.TransformStamped: Where one frame is in another..
---@class geometry_msgs.TransformStamped.In : InPort
---@field read fun(self: geometry_msgs.TransformStamped.In): geometry_msgs.TransformStamped

---An out-port of geometry_msgs.TransformStamped: Where one frame is in another..
---@class geometry_msgs.TransformStamped.Out : OutPort
---@field write fun(self: geometry_msgs.TransformStamped.Out, value: geometry_msgs.TransformStamped.Written)

---@class (exact) geometry_msgs.TransformStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.TransformStamped.OutOptions
---@field safe? geometry_msgs.TransformStamped.Written written when the component stops

---An in-port of geometry_msgs.Twist: A velocity and a rate of turn..
---@class geometry_msgs.Twist.In : InPort
---@field read fun(self: geometry_msgs.Twist.In): geometry_msgs.Twist

---An out-port of geometry_msgs.Twist: A velocity and a rate of turn..
---@class geometry_msgs.Twist.Out : OutPort
---@field write fun(self: geometry_msgs.Twist.Out, value: geometry_msgs.Twist.Written)

---@class (exact) geometry_msgs.Twist.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Twist.OutOptions
---@field safe? geometry_msgs.Twist.Written written when the component stops

---An in-port of geometry_msgs.TwistStamped: A Twist with its time and frame..
---@class geometry_msgs.TwistStamped.In : InPort
---@field read fun(self: geometry_msgs.TwistStamped.In): geometry_msgs.TwistStamped

---An out-port of geometry_msgs.TwistStamped: A Twist with its time and frame..
---@class geometry_msgs.TwistStamped.Out : OutPort
---@field write fun(self: geometry_msgs.TwistStamped.Out, value: geometry_msgs.TwistStamped.Written)

---@class (exact) geometry_msgs.TwistStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.TwistStamped.OutOptions
---@field safe? geometry_msgs.TwistStamped.Written written when the component stops

---An in-port of geometry_msgs.TwistWithCovariance: A Twist and how sure it is..
---@class geometry_msgs.TwistWithCovariance.In : InPort
---@field read fun(self: geometry_msgs.TwistWithCovariance.In): geometry_msgs.TwistWithCovariance

---An out-port of geometry_msgs.TwistWithCovariance: A Twist and how sure it is..
---@class geometry_msgs.TwistWithCovariance.Out : OutPort
---@field write fun(self: geometry_msgs.TwistWithCovariance.Out, value: geometry_msgs.TwistWithCovariance.Written)

---@class (exact) geometry_msgs.TwistWithCovariance.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.TwistWithCovariance.OutOptions
---@field safe? geometry_msgs.TwistWithCovariance.Written written when the component stops

---An in-port of geometry_msgs.TwistWithCovarianceStamped: A TwistWithCovariance with its time and frame..
---@class geometry_msgs.TwistWithCovarianceStamped.In : InPort
---@field read fun(self: geometry_msgs.TwistWithCovarianceStamped.In): geometry_msgs.TwistWithCovarianceStamped

---An out-port of geometry_msgs.TwistWithCovarianceStamped: A TwistWithCovariance with its time and frame..
---@class geometry_msgs.TwistWithCovarianceStamped.Out : OutPort
---@field write fun(self: geometry_msgs.TwistWithCovarianceStamped.Out, value: geometry_msgs.TwistWithCovarianceStamped.Written)

---@class (exact) geometry_msgs.TwistWithCovarianceStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.TwistWithCovarianceStamped.OutOptions
---@field safe? geometry_msgs.TwistWithCovarianceStamped.Written written when the component stops

---An in-port of geometry_msgs.Vector3: A direction and a size in space..
---@class geometry_msgs.Vector3.In : InPort
---@field read fun(self: geometry_msgs.Vector3.In): geometry_msgs.Vector3

---An out-port of geometry_msgs.Vector3: A direction and a size in space..
---@class geometry_msgs.Vector3.Out : OutPort
---@field write fun(self: geometry_msgs.Vector3.Out, value: geometry_msgs.Vector3.Written)

---@class (exact) geometry_msgs.Vector3.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Vector3.OutOptions
---@field safe? geometry_msgs.Vector3.Written written when the component stops

---An in-port of geometry_msgs.Vector3Stamped: A Vector3 with its time and frame..
---@class geometry_msgs.Vector3Stamped.In : InPort
---@field read fun(self: geometry_msgs.Vector3Stamped.In): geometry_msgs.Vector3Stamped

---An out-port of geometry_msgs.Vector3Stamped: A Vector3 with its time and frame..
---@class geometry_msgs.Vector3Stamped.Out : OutPort
---@field write fun(self: geometry_msgs.Vector3Stamped.Out, value: geometry_msgs.Vector3Stamped.Written)

---@class (exact) geometry_msgs.Vector3Stamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Vector3Stamped.OutOptions
---@field safe? geometry_msgs.Vector3Stamped.Written written when the component stops

---An in-port of geometry_msgs.Wrench: A force and a torque..
---@class geometry_msgs.Wrench.In : InPort
---@field read fun(self: geometry_msgs.Wrench.In): geometry_msgs.Wrench

---An out-port of geometry_msgs.Wrench: A force and a torque..
---@class geometry_msgs.Wrench.Out : OutPort
---@field write fun(self: geometry_msgs.Wrench.Out, value: geometry_msgs.Wrench.Written)

---@class (exact) geometry_msgs.Wrench.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.Wrench.OutOptions
---@field safe? geometry_msgs.Wrench.Written written when the component stops

---An in-port of geometry_msgs.WrenchStamped: A Wrench with its time and frame..
---@class geometry_msgs.WrenchStamped.In : InPort
---@field read fun(self: geometry_msgs.WrenchStamped.In): geometry_msgs.WrenchStamped

---An out-port of geometry_msgs.WrenchStamped: A Wrench with its time and frame..
---@class geometry_msgs.WrenchStamped.Out : OutPort
---@field write fun(self: geometry_msgs.WrenchStamped.Out, value: geometry_msgs.WrenchStamped.Written)

---@class (exact) geometry_msgs.WrenchStamped.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) geometry_msgs.WrenchStamped.OutOptions
---@field safe? geometry_msgs.WrenchStamped.Written written when the component stops

---An in-port of nav_msgs.GridCells: Cells of a grid, each by its middle..
---@class nav_msgs.GridCells.In : InPort
---@field read fun(self: nav_msgs.GridCells.In): nav_msgs.GridCells

---An out-port of nav_msgs.GridCells: Cells of a grid, each by its middle..
---@class nav_msgs.GridCells.Out : OutPort
---@field write fun(self: nav_msgs.GridCells.Out, value: nav_msgs.GridCells.Written)

---@class (exact) nav_msgs.GridCells.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) nav_msgs.GridCells.OutOptions
---@field safe? nav_msgs.GridCells.Written written when the component stops

---An in-port of nav_msgs.MapMetaData: What a map covers..
---@class nav_msgs.MapMetaData.In : InPort
---@field read fun(self: nav_msgs.MapMetaData.In): nav_msgs.MapMetaData

---An out-port of nav_msgs.MapMetaData: What a map covers..
---@class nav_msgs.MapMetaData.Out : OutPort
---@field write fun(self: nav_msgs.MapMetaData.Out, value: nav_msgs.MapMetaData.Written)

---@class (exact) nav_msgs.MapMetaData.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) nav_msgs.MapMetaData.OutOptions
---@field safe? nav_msgs.MapMetaData.Written written when the component stops

---An in-port of nav_msgs.OccupancyGrid: A map of cells that are free or not..
---@class nav_msgs.OccupancyGrid.In : InPort
---@field read fun(self: nav_msgs.OccupancyGrid.In): nav_msgs.OccupancyGrid

---An out-port of nav_msgs.OccupancyGrid: A map of cells that are free or not..
---@class nav_msgs.OccupancyGrid.Out : OutPort
---@field write fun(self: nav_msgs.OccupancyGrid.Out, value: nav_msgs.OccupancyGrid.Written)

---@class (exact) nav_msgs.OccupancyGrid.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) nav_msgs.OccupancyGrid.OutOptions
---@field safe? nav_msgs.OccupancyGrid.Written written when the component stops

---An in-port of nav_msgs.Odometry: Where a robot believes to be, and how fast it moves..
---@class nav_msgs.Odometry.In : InPort
---@field read fun(self: nav_msgs.Odometry.In): nav_msgs.Odometry

---An out-port of nav_msgs.Odometry: Where a robot believes to be, and how fast it moves..
---@class nav_msgs.Odometry.Out : OutPort
---@field write fun(self: nav_msgs.Odometry.Out, value: nav_msgs.Odometry.Written)

---@class (exact) nav_msgs.Odometry.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) nav_msgs.Odometry.OutOptions
---@field safe? nav_msgs.Odometry.Written written when the component stops

---An in-port of nav_msgs.Path: A way to go, pose by pose..
---@class nav_msgs.Path.In : InPort
---@field read fun(self: nav_msgs.Path.In): nav_msgs.Path

---An out-port of nav_msgs.Path: A way to go, pose by pose..
---@class nav_msgs.Path.Out : OutPort
---@field write fun(self: nav_msgs.Path.Out, value: nav_msgs.Path.Written)

---@class (exact) nav_msgs.Path.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) nav_msgs.Path.OutOptions
---@field safe? nav_msgs.Path.Written written when the component stops

---An in-port of raspimouse_msgs.Leds: The four LEDs of a Raspberry Pi Mouse..
---@class raspimouse_msgs.Leds.In : InPort
---@field read fun(self: raspimouse_msgs.Leds.In): raspimouse_msgs.Leds

---An out-port of raspimouse_msgs.Leds: The four LEDs of a Raspberry Pi Mouse..
---@class raspimouse_msgs.Leds.Out : OutPort
---@field write fun(self: raspimouse_msgs.Leds.Out, value: raspimouse_msgs.Leds.Written)

---@class (exact) raspimouse_msgs.Leds.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) raspimouse_msgs.Leds.OutOptions
---@field safe? raspimouse_msgs.Leds.Written written when the component stops

---An in-port of raspimouse_msgs.LightSensors: The four light sensors of a Raspberry Pi Mouse; a larger value is nearer..
---@class raspimouse_msgs.LightSensors.In : InPort
---@field read fun(self: raspimouse_msgs.LightSensors.In): raspimouse_msgs.LightSensors

---An out-port of raspimouse_msgs.LightSensors: The four light sensors of a Raspberry Pi Mouse; a larger value is nearer..
---@class raspimouse_msgs.LightSensors.Out : OutPort
---@field write fun(self: raspimouse_msgs.LightSensors.Out, value: raspimouse_msgs.LightSensors.Written)

---@class (exact) raspimouse_msgs.LightSensors.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) raspimouse_msgs.LightSensors.OutOptions
---@field safe? raspimouse_msgs.LightSensors.Written written when the component stops

---An in-port of raspimouse_msgs.Switches: The three switches of a Raspberry Pi Mouse..
---@class raspimouse_msgs.Switches.In : InPort
---@field read fun(self: raspimouse_msgs.Switches.In): raspimouse_msgs.Switches

---An out-port of raspimouse_msgs.Switches: The three switches of a Raspberry Pi Mouse..
---@class raspimouse_msgs.Switches.Out : OutPort
---@field write fun(self: raspimouse_msgs.Switches.Out, value: raspimouse_msgs.Switches.Written)

---@class (exact) raspimouse_msgs.Switches.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) raspimouse_msgs.Switches.OutOptions
---@field safe? raspimouse_msgs.Switches.Written written when the component stops

---An in-port of sensor_msgs.BatteryState: How a battery is. A number that is not measured is NaN..
---@class sensor_msgs.BatteryState.In : InPort
---@field read fun(self: sensor_msgs.BatteryState.In): sensor_msgs.BatteryState

---An out-port of sensor_msgs.BatteryState: How a battery is. A number that is not measured is NaN..
---@class sensor_msgs.BatteryState.Out : OutPort
---@field write fun(self: sensor_msgs.BatteryState.Out, value: sensor_msgs.BatteryState.Written)

---@class (exact) sensor_msgs.BatteryState.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.BatteryState.OutOptions
---@field safe? sensor_msgs.BatteryState.Written written when the component stops

---An in-port of sensor_msgs.CameraInfo: How a camera maps space to its pictures..
---@class sensor_msgs.CameraInfo.In : InPort
---@field read fun(self: sensor_msgs.CameraInfo.In): sensor_msgs.CameraInfo

---An out-port of sensor_msgs.CameraInfo: How a camera maps space to its pictures..
---@class sensor_msgs.CameraInfo.Out : OutPort
---@field write fun(self: sensor_msgs.CameraInfo.Out, value: sensor_msgs.CameraInfo.Written)

---@class (exact) sensor_msgs.CameraInfo.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.CameraInfo.OutOptions
---@field safe? sensor_msgs.CameraInfo.Written written when the component stops

---An in-port of sensor_msgs.ChannelFloat32: One more number for each point of a cloud..
---@class sensor_msgs.ChannelFloat32.In : InPort
---@field read fun(self: sensor_msgs.ChannelFloat32.In): sensor_msgs.ChannelFloat32

---An out-port of sensor_msgs.ChannelFloat32: One more number for each point of a cloud..
---@class sensor_msgs.ChannelFloat32.Out : OutPort
---@field write fun(self: sensor_msgs.ChannelFloat32.Out, value: sensor_msgs.ChannelFloat32.Written)

---@class (exact) sensor_msgs.ChannelFloat32.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.ChannelFloat32.OutOptions
---@field safe? sensor_msgs.ChannelFloat32.Written written when the component stops

---An in-port of sensor_msgs.CompressedImage: A picture in a file format..
---@class sensor_msgs.CompressedImage.In : InPort
---@field read fun(self: sensor_msgs.CompressedImage.In): sensor_msgs.CompressedImage

---An out-port of sensor_msgs.CompressedImage: A picture in a file format..
---@class sensor_msgs.CompressedImage.Out : OutPort
---@field write fun(self: sensor_msgs.CompressedImage.Out, value: sensor_msgs.CompressedImage.Written)

---@class (exact) sensor_msgs.CompressedImage.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.CompressedImage.OutOptions
---@field safe? sensor_msgs.CompressedImage.Written written when the component stops

---An in-port of sensor_msgs.FluidPressure: A pressure of air or water..
---@class sensor_msgs.FluidPressure.In : InPort
---@field read fun(self: sensor_msgs.FluidPressure.In): sensor_msgs.FluidPressure

---An out-port of sensor_msgs.FluidPressure: A pressure of air or water..
---@class sensor_msgs.FluidPressure.Out : OutPort
---@field write fun(self: sensor_msgs.FluidPressure.Out, value: sensor_msgs.FluidPressure.Written)

---@class (exact) sensor_msgs.FluidPressure.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.FluidPressure.OutOptions
---@field safe? sensor_msgs.FluidPressure.Written written when the component stops

---An in-port of sensor_msgs.Illuminance: How much light falls on a sensor..
---@class sensor_msgs.Illuminance.In : InPort
---@field read fun(self: sensor_msgs.Illuminance.In): sensor_msgs.Illuminance

---An out-port of sensor_msgs.Illuminance: How much light falls on a sensor..
---@class sensor_msgs.Illuminance.Out : OutPort
---@field write fun(self: sensor_msgs.Illuminance.Out, value: sensor_msgs.Illuminance.Written)

---@class (exact) sensor_msgs.Illuminance.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.Illuminance.OutOptions
---@field safe? sensor_msgs.Illuminance.Written written when the component stops

---An in-port of sensor_msgs.Image: A picture, pixel by pixel..
---@class sensor_msgs.Image.In : InPort
---@field read fun(self: sensor_msgs.Image.In): sensor_msgs.Image

---An out-port of sensor_msgs.Image: A picture, pixel by pixel..
---@class sensor_msgs.Image.Out : OutPort
---@field write fun(self: sensor_msgs.Image.Out, value: sensor_msgs.Image.Written)

---@class (exact) sensor_msgs.Image.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.Image.OutOptions
---@field safe? sensor_msgs.Image.Written written when the component stops

---An in-port of sensor_msgs.Imu: What an inertial sensor measures. A covariance that begins with -1: that is not measured..
---@class sensor_msgs.Imu.In : InPort
---@field read fun(self: sensor_msgs.Imu.In): sensor_msgs.Imu

---An out-port of sensor_msgs.Imu: What an inertial sensor measures. A covariance that begins with -1: that is not measured..
---@class sensor_msgs.Imu.Out : OutPort
---@field write fun(self: sensor_msgs.Imu.Out, value: sensor_msgs.Imu.Written)

---@class (exact) sensor_msgs.Imu.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.Imu.OutOptions
---@field safe? sensor_msgs.Imu.Written written when the component stops

---An in-port of sensor_msgs.JointState: The joints of a robot, in one order..
---@class sensor_msgs.JointState.In : InPort
---@field read fun(self: sensor_msgs.JointState.In): sensor_msgs.JointState

---An out-port of sensor_msgs.JointState: The joints of a robot, in one order..
---@class sensor_msgs.JointState.Out : OutPort
---@field write fun(self: sensor_msgs.JointState.Out, value: sensor_msgs.JointState.Written)

---@class (exact) sensor_msgs.JointState.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.JointState.OutOptions
---@field safe? sensor_msgs.JointState.Written written when the component stops

---An in-port of sensor_msgs.Joy: The axes and buttons of a gamepad..
---@class sensor_msgs.Joy.In : InPort
---@field read fun(self: sensor_msgs.Joy.In): sensor_msgs.Joy

---An out-port of sensor_msgs.Joy: The axes and buttons of a gamepad..
---@class sensor_msgs.Joy.Out : OutPort
---@field write fun(self: sensor_msgs.Joy.Out, value: sensor_msgs.Joy.Written)

---@class (exact) sensor_msgs.Joy.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.Joy.OutOptions
---@field safe? sensor_msgs.Joy.Written written when the component stops

---An in-port of sensor_msgs.JoyFeedback: What a gamepad is to do..
---@class sensor_msgs.JoyFeedback.In : InPort
---@field read fun(self: sensor_msgs.JoyFeedback.In): sensor_msgs.JoyFeedback

---An out-port of sensor_msgs.JoyFeedback: What a gamepad is to do..
---@class sensor_msgs.JoyFeedback.Out : OutPort
---@field write fun(self: sensor_msgs.JoyFeedback.Out, value: sensor_msgs.JoyFeedback.Written)

---@class (exact) sensor_msgs.JoyFeedback.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.JoyFeedback.OutOptions
---@field safe? sensor_msgs.JoyFeedback.Written written when the component stops

---An in-port of sensor_msgs.JoyFeedbackArray: Several things that a gamepad is to do..
---@class sensor_msgs.JoyFeedbackArray.In : InPort
---@field read fun(self: sensor_msgs.JoyFeedbackArray.In): sensor_msgs.JoyFeedbackArray

---An out-port of sensor_msgs.JoyFeedbackArray: Several things that a gamepad is to do..
---@class sensor_msgs.JoyFeedbackArray.Out : OutPort
---@field write fun(self: sensor_msgs.JoyFeedbackArray.Out, value: sensor_msgs.JoyFeedbackArray.Written)

---@class (exact) sensor_msgs.JoyFeedbackArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.JoyFeedbackArray.OutOptions
---@field safe? sensor_msgs.JoyFeedbackArray.Written written when the component stops

---An in-port of sensor_msgs.LaserEcho: All echoes of one ray..
---@class sensor_msgs.LaserEcho.In : InPort
---@field read fun(self: sensor_msgs.LaserEcho.In): sensor_msgs.LaserEcho

---An out-port of sensor_msgs.LaserEcho: All echoes of one ray..
---@class sensor_msgs.LaserEcho.Out : OutPort
---@field write fun(self: sensor_msgs.LaserEcho.Out, value: sensor_msgs.LaserEcho.Written)

---@class (exact) sensor_msgs.LaserEcho.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.LaserEcho.OutOptions
---@field safe? sensor_msgs.LaserEcho.Written written when the component stops

---An in-port of sensor_msgs.LaserScan: Distances that a scanner measured, from one angle to another..
---@class sensor_msgs.LaserScan.In : InPort
---@field read fun(self: sensor_msgs.LaserScan.In): sensor_msgs.LaserScan

---An out-port of sensor_msgs.LaserScan: Distances that a scanner measured, from one angle to another..
---@class sensor_msgs.LaserScan.Out : OutPort
---@field write fun(self: sensor_msgs.LaserScan.Out, value: sensor_msgs.LaserScan.Written)

---@class (exact) sensor_msgs.LaserScan.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.LaserScan.OutOptions
---@field safe? sensor_msgs.LaserScan.Written written when the component stops

---An in-port of sensor_msgs.MagneticField: A magnetic field..
---@class sensor_msgs.MagneticField.In : InPort
---@field read fun(self: sensor_msgs.MagneticField.In): sensor_msgs.MagneticField

---An out-port of sensor_msgs.MagneticField: A magnetic field..
---@class sensor_msgs.MagneticField.Out : OutPort
---@field write fun(self: sensor_msgs.MagneticField.Out, value: sensor_msgs.MagneticField.Written)

---@class (exact) sensor_msgs.MagneticField.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.MagneticField.OutOptions
---@field safe? sensor_msgs.MagneticField.Written written when the component stops

---An in-port of sensor_msgs.MultiDOFJointState: Joints that move in several ways at once, in one order..
---@class sensor_msgs.MultiDOFJointState.In : InPort
---@field read fun(self: sensor_msgs.MultiDOFJointState.In): sensor_msgs.MultiDOFJointState

---An out-port of sensor_msgs.MultiDOFJointState: Joints that move in several ways at once, in one order..
---@class sensor_msgs.MultiDOFJointState.Out : OutPort
---@field write fun(self: sensor_msgs.MultiDOFJointState.Out, value: sensor_msgs.MultiDOFJointState.Written)

---@class (exact) sensor_msgs.MultiDOFJointState.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.MultiDOFJointState.OutOptions
---@field safe? sensor_msgs.MultiDOFJointState.Written written when the component stops

---An in-port of sensor_msgs.MultiEchoLaserScan: A scan with several echoes of each ray..
---@class sensor_msgs.MultiEchoLaserScan.In : InPort
---@field read fun(self: sensor_msgs.MultiEchoLaserScan.In): sensor_msgs.MultiEchoLaserScan

---An out-port of sensor_msgs.MultiEchoLaserScan: A scan with several echoes of each ray..
---@class sensor_msgs.MultiEchoLaserScan.Out : OutPort
---@field write fun(self: sensor_msgs.MultiEchoLaserScan.Out, value: sensor_msgs.MultiEchoLaserScan.Written)

---@class (exact) sensor_msgs.MultiEchoLaserScan.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.MultiEchoLaserScan.OutOptions
---@field safe? sensor_msgs.MultiEchoLaserScan.Written written when the component stops

---An in-port of sensor_msgs.NavSatFix: Where on earth satellites place a receiver..
---@class sensor_msgs.NavSatFix.In : InPort
---@field read fun(self: sensor_msgs.NavSatFix.In): sensor_msgs.NavSatFix

---An out-port of sensor_msgs.NavSatFix: Where on earth satellites place a receiver..
---@class sensor_msgs.NavSatFix.Out : OutPort
---@field write fun(self: sensor_msgs.NavSatFix.Out, value: sensor_msgs.NavSatFix.Written)

---@class (exact) sensor_msgs.NavSatFix.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.NavSatFix.OutOptions
---@field safe? sensor_msgs.NavSatFix.Written written when the component stops

---An in-port of sensor_msgs.NavSatStatus: What a receiver of satellites has found..
---@class sensor_msgs.NavSatStatus.In : InPort
---@field read fun(self: sensor_msgs.NavSatStatus.In): sensor_msgs.NavSatStatus

---An out-port of sensor_msgs.NavSatStatus: What a receiver of satellites has found..
---@class sensor_msgs.NavSatStatus.Out : OutPort
---@field write fun(self: sensor_msgs.NavSatStatus.Out, value: sensor_msgs.NavSatStatus.Written)

---@class (exact) sensor_msgs.NavSatStatus.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.NavSatStatus.OutOptions
---@field safe? sensor_msgs.NavSatStatus.Written written when the component stops

---An in-port of sensor_msgs.PointCloud: Points in space, with more numbers of each..
---@class sensor_msgs.PointCloud.In : InPort
---@field read fun(self: sensor_msgs.PointCloud.In): sensor_msgs.PointCloud

---An out-port of sensor_msgs.PointCloud: Points in space, with more numbers of each..
---@class sensor_msgs.PointCloud.Out : OutPort
---@field write fun(self: sensor_msgs.PointCloud.Out, value: sensor_msgs.PointCloud.Written)

---@class (exact) sensor_msgs.PointCloud.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.PointCloud.OutOptions
---@field safe? sensor_msgs.PointCloud.Written written when the component stops

---An in-port of sensor_msgs.PointCloud2: Points in space as bytes that fields describe..
---@class sensor_msgs.PointCloud2.In : InPort
---@field read fun(self: sensor_msgs.PointCloud2.In): sensor_msgs.PointCloud2

---An out-port of sensor_msgs.PointCloud2: Points in space as bytes that fields describe..
---@class sensor_msgs.PointCloud2.Out : OutPort
---@field write fun(self: sensor_msgs.PointCloud2.Out, value: sensor_msgs.PointCloud2.Written)

---@class (exact) sensor_msgs.PointCloud2.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.PointCloud2.OutOptions
---@field safe? sensor_msgs.PointCloud2.Written written when the component stops

---An in-port of sensor_msgs.PointField: One number of each point of a cloud of bytes..
---@class sensor_msgs.PointField.In : InPort
---@field read fun(self: sensor_msgs.PointField.In): sensor_msgs.PointField

---An out-port of sensor_msgs.PointField: One number of each point of a cloud of bytes..
---@class sensor_msgs.PointField.Out : OutPort
---@field write fun(self: sensor_msgs.PointField.Out, value: sensor_msgs.PointField.Written)

---@class (exact) sensor_msgs.PointField.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.PointField.OutOptions
---@field safe? sensor_msgs.PointField.Written written when the component stops

---An in-port of sensor_msgs.Range: A distance that one sensor measured. Minus infinity: too near; infinity: nothing within reach..
---@class sensor_msgs.Range.In : InPort
---@field read fun(self: sensor_msgs.Range.In): sensor_msgs.Range

---An out-port of sensor_msgs.Range: A distance that one sensor measured. Minus infinity: too near; infinity: nothing within reach..
---@class sensor_msgs.Range.Out : OutPort
---@field write fun(self: sensor_msgs.Range.Out, value: sensor_msgs.Range.Written)

---@class (exact) sensor_msgs.Range.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.Range.OutOptions
---@field safe? sensor_msgs.Range.Written written when the component stops

---An in-port of sensor_msgs.RegionOfInterest: A part of a picture..
---@class sensor_msgs.RegionOfInterest.In : InPort
---@field read fun(self: sensor_msgs.RegionOfInterest.In): sensor_msgs.RegionOfInterest

---An out-port of sensor_msgs.RegionOfInterest: A part of a picture..
---@class sensor_msgs.RegionOfInterest.Out : OutPort
---@field write fun(self: sensor_msgs.RegionOfInterest.Out, value: sensor_msgs.RegionOfInterest.Written)

---@class (exact) sensor_msgs.RegionOfInterest.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.RegionOfInterest.OutOptions
---@field safe? sensor_msgs.RegionOfInterest.Written written when the component stops

---An in-port of sensor_msgs.RelativeHumidity: How much water is in the air..
---@class sensor_msgs.RelativeHumidity.In : InPort
---@field read fun(self: sensor_msgs.RelativeHumidity.In): sensor_msgs.RelativeHumidity

---An out-port of sensor_msgs.RelativeHumidity: How much water is in the air..
---@class sensor_msgs.RelativeHumidity.Out : OutPort
---@field write fun(self: sensor_msgs.RelativeHumidity.Out, value: sensor_msgs.RelativeHumidity.Written)

---@class (exact) sensor_msgs.RelativeHumidity.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.RelativeHumidity.OutOptions
---@field safe? sensor_msgs.RelativeHumidity.Written written when the component stops

---An in-port of sensor_msgs.Temperature: A temperature..
---@class sensor_msgs.Temperature.In : InPort
---@field read fun(self: sensor_msgs.Temperature.In): sensor_msgs.Temperature

---An out-port of sensor_msgs.Temperature: A temperature..
---@class sensor_msgs.Temperature.Out : OutPort
---@field write fun(self: sensor_msgs.Temperature.Out, value: sensor_msgs.Temperature.Written)

---@class (exact) sensor_msgs.Temperature.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.Temperature.OutOptions
---@field safe? sensor_msgs.Temperature.Written written when the component stops

---An in-port of sensor_msgs.TimeReference: The time of another clock..
---@class sensor_msgs.TimeReference.In : InPort
---@field read fun(self: sensor_msgs.TimeReference.In): sensor_msgs.TimeReference

---An out-port of sensor_msgs.TimeReference: The time of another clock..
---@class sensor_msgs.TimeReference.Out : OutPort
---@field write fun(self: sensor_msgs.TimeReference.Out, value: sensor_msgs.TimeReference.Written)

---@class (exact) sensor_msgs.TimeReference.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) sensor_msgs.TimeReference.OutOptions
---@field safe? sensor_msgs.TimeReference.Written written when the component stops

---An in-port of std_msgs.Bool: One bool..
---@class std_msgs.Bool.In : InPort
---@field read fun(self: std_msgs.Bool.In): std_msgs.Bool

---An out-port of std_msgs.Bool: One bool..
---@class std_msgs.Bool.Out : OutPort
---@field write fun(self: std_msgs.Bool.Out, value: std_msgs.Bool.Written)

---@class (exact) std_msgs.Bool.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Bool.OutOptions
---@field safe? std_msgs.Bool.Written written when the component stops

---An in-port of std_msgs.Byte: One byte..
---@class std_msgs.Byte.In : InPort
---@field read fun(self: std_msgs.Byte.In): std_msgs.Byte

---An out-port of std_msgs.Byte: One byte..
---@class std_msgs.Byte.Out : OutPort
---@field write fun(self: std_msgs.Byte.Out, value: std_msgs.Byte.Written)

---@class (exact) std_msgs.Byte.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Byte.OutOptions
---@field safe? std_msgs.Byte.Written written when the component stops

---An in-port of std_msgs.ByteMultiArray: An array of byte in any number of dimensions..
---@class std_msgs.ByteMultiArray.In : InPort
---@field read fun(self: std_msgs.ByteMultiArray.In): std_msgs.ByteMultiArray

---An out-port of std_msgs.ByteMultiArray: An array of byte in any number of dimensions..
---@class std_msgs.ByteMultiArray.Out : OutPort
---@field write fun(self: std_msgs.ByteMultiArray.Out, value: std_msgs.ByteMultiArray.Written)

---@class (exact) std_msgs.ByteMultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.ByteMultiArray.OutOptions
---@field safe? std_msgs.ByteMultiArray.Written written when the component stops

---An in-port of std_msgs.Char: One char..
---@class std_msgs.Char.In : InPort
---@field read fun(self: std_msgs.Char.In): std_msgs.Char

---An out-port of std_msgs.Char: One char..
---@class std_msgs.Char.Out : OutPort
---@field write fun(self: std_msgs.Char.Out, value: std_msgs.Char.Written)

---@class (exact) std_msgs.Char.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Char.OutOptions
---@field safe? std_msgs.Char.Written written when the component stops

---An in-port of std_msgs.ColorRGBA: A colour; each part from 0 to 1..
---@class std_msgs.ColorRGBA.In : InPort
---@field read fun(self: std_msgs.ColorRGBA.In): std_msgs.ColorRGBA

---An out-port of std_msgs.ColorRGBA: A colour; each part from 0 to 1..
---@class std_msgs.ColorRGBA.Out : OutPort
---@field write fun(self: std_msgs.ColorRGBA.Out, value: std_msgs.ColorRGBA.Written)

---@class (exact) std_msgs.ColorRGBA.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.ColorRGBA.OutOptions
---@field safe? std_msgs.ColorRGBA.Written written when the component stops

---An in-port of std_msgs.Empty: Nothing: that it comes says all..
---@class std_msgs.Empty.In : InPort
---@field read fun(self: std_msgs.Empty.In): std_msgs.Empty

---An out-port of std_msgs.Empty: Nothing: that it comes says all..
---@class std_msgs.Empty.Out : OutPort
---@field write fun(self: std_msgs.Empty.Out, value: std_msgs.Empty.Written)

---@class (exact) std_msgs.Empty.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Empty.OutOptions
---@field safe? std_msgs.Empty.Written written when the component stops

---An in-port of std_msgs.Float32: One float32..
---@class std_msgs.Float32.In : InPort
---@field read fun(self: std_msgs.Float32.In): std_msgs.Float32

---An out-port of std_msgs.Float32: One float32..
---@class std_msgs.Float32.Out : OutPort
---@field write fun(self: std_msgs.Float32.Out, value: std_msgs.Float32.Written)

---@class (exact) std_msgs.Float32.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Float32.OutOptions
---@field safe? std_msgs.Float32.Written written when the component stops

---An in-port of std_msgs.Float32MultiArray: An array of float32 in any number of dimensions..
---@class std_msgs.Float32MultiArray.In : InPort
---@field read fun(self: std_msgs.Float32MultiArray.In): std_msgs.Float32MultiArray

---An out-port of std_msgs.Float32MultiArray: An array of float32 in any number of dimensions..
---@class std_msgs.Float32MultiArray.Out : OutPort
---@field write fun(self: std_msgs.Float32MultiArray.Out, value: std_msgs.Float32MultiArray.Written)

---@class (exact) std_msgs.Float32MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Float32MultiArray.OutOptions
---@field safe? std_msgs.Float32MultiArray.Written written when the component stops

---An in-port of std_msgs.Float64: One float64..
---@class std_msgs.Float64.In : InPort
---@field read fun(self: std_msgs.Float64.In): std_msgs.Float64

---An out-port of std_msgs.Float64: One float64..
---@class std_msgs.Float64.Out : OutPort
---@field write fun(self: std_msgs.Float64.Out, value: std_msgs.Float64.Written)

---@class (exact) std_msgs.Float64.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Float64.OutOptions
---@field safe? std_msgs.Float64.Written written when the component stops

---An in-port of std_msgs.Float64MultiArray: An array of float64 in any number of dimensions..
---@class std_msgs.Float64MultiArray.In : InPort
---@field read fun(self: std_msgs.Float64MultiArray.In): std_msgs.Float64MultiArray

---An out-port of std_msgs.Float64MultiArray: An array of float64 in any number of dimensions..
---@class std_msgs.Float64MultiArray.Out : OutPort
---@field write fun(self: std_msgs.Float64MultiArray.Out, value: std_msgs.Float64MultiArray.Written)

---@class (exact) std_msgs.Float64MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Float64MultiArray.OutOptions
---@field safe? std_msgs.Float64MultiArray.Written written when the component stops

---An in-port of std_msgs.Header: When a measurement was made, and in which frame its coordinates are..
---@class std_msgs.Header.In : InPort
---@field read fun(self: std_msgs.Header.In): std_msgs.Header

---An out-port of std_msgs.Header: When a measurement was made, and in which frame its coordinates are..
---@class std_msgs.Header.Out : OutPort
---@field write fun(self: std_msgs.Header.Out, value: std_msgs.Header.Written)

---@class (exact) std_msgs.Header.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Header.OutOptions
---@field safe? std_msgs.Header.Written written when the component stops

---An in-port of std_msgs.Int16: One int16..
---@class std_msgs.Int16.In : InPort
---@field read fun(self: std_msgs.Int16.In): std_msgs.Int16

---An out-port of std_msgs.Int16: One int16..
---@class std_msgs.Int16.Out : OutPort
---@field write fun(self: std_msgs.Int16.Out, value: std_msgs.Int16.Written)

---@class (exact) std_msgs.Int16.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Int16.OutOptions
---@field safe? std_msgs.Int16.Written written when the component stops

---An in-port of std_msgs.Int16MultiArray: An array of int16 in any number of dimensions..
---@class std_msgs.Int16MultiArray.In : InPort
---@field read fun(self: std_msgs.Int16MultiArray.In): std_msgs.Int16MultiArray

---An out-port of std_msgs.Int16MultiArray: An array of int16 in any number of dimensions..
---@class std_msgs.Int16MultiArray.Out : OutPort
---@field write fun(self: std_msgs.Int16MultiArray.Out, value: std_msgs.Int16MultiArray.Written)

---@class (exact) std_msgs.Int16MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Int16MultiArray.OutOptions
---@field safe? std_msgs.Int16MultiArray.Written written when the component stops

---An in-port of std_msgs.Int32: One int32..
---@class std_msgs.Int32.In : InPort
---@field read fun(self: std_msgs.Int32.In): std_msgs.Int32

---An out-port of std_msgs.Int32: One int32..
---@class std_msgs.Int32.Out : OutPort
---@field write fun(self: std_msgs.Int32.Out, value: std_msgs.Int32.Written)

---@class (exact) std_msgs.Int32.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Int32.OutOptions
---@field safe? std_msgs.Int32.Written written when the component stops

---An in-port of std_msgs.Int32MultiArray: An array of int32 in any number of dimensions..
---@class std_msgs.Int32MultiArray.In : InPort
---@field read fun(self: std_msgs.Int32MultiArray.In): std_msgs.Int32MultiArray

---An out-port of std_msgs.Int32MultiArray: An array of int32 in any number of dimensions..
---@class std_msgs.Int32MultiArray.Out : OutPort
---@field write fun(self: std_msgs.Int32MultiArray.Out, value: std_msgs.Int32MultiArray.Written)

---@class (exact) std_msgs.Int32MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Int32MultiArray.OutOptions
---@field safe? std_msgs.Int32MultiArray.Written written when the component stops

---An in-port of std_msgs.Int64: One int64..
---@class std_msgs.Int64.In : InPort
---@field read fun(self: std_msgs.Int64.In): std_msgs.Int64

---An out-port of std_msgs.Int64: One int64..
---@class std_msgs.Int64.Out : OutPort
---@field write fun(self: std_msgs.Int64.Out, value: std_msgs.Int64.Written)

---@class (exact) std_msgs.Int64.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Int64.OutOptions
---@field safe? std_msgs.Int64.Written written when the component stops

---An in-port of std_msgs.Int64MultiArray: An array of int64 in any number of dimensions..
---@class std_msgs.Int64MultiArray.In : InPort
---@field read fun(self: std_msgs.Int64MultiArray.In): std_msgs.Int64MultiArray

---An out-port of std_msgs.Int64MultiArray: An array of int64 in any number of dimensions..
---@class std_msgs.Int64MultiArray.Out : OutPort
---@field write fun(self: std_msgs.Int64MultiArray.Out, value: std_msgs.Int64MultiArray.Written)

---@class (exact) std_msgs.Int64MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Int64MultiArray.OutOptions
---@field safe? std_msgs.Int64MultiArray.Written written when the component stops

---An in-port of std_msgs.Int8: One int8..
---@class std_msgs.Int8.In : InPort
---@field read fun(self: std_msgs.Int8.In): std_msgs.Int8

---An out-port of std_msgs.Int8: One int8..
---@class std_msgs.Int8.Out : OutPort
---@field write fun(self: std_msgs.Int8.Out, value: std_msgs.Int8.Written)

---@class (exact) std_msgs.Int8.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Int8.OutOptions
---@field safe? std_msgs.Int8.Written written when the component stops

---An in-port of std_msgs.Int8MultiArray: An array of int8 in any number of dimensions..
---@class std_msgs.Int8MultiArray.In : InPort
---@field read fun(self: std_msgs.Int8MultiArray.In): std_msgs.Int8MultiArray

---An out-port of std_msgs.Int8MultiArray: An array of int8 in any number of dimensions..
---@class std_msgs.Int8MultiArray.Out : OutPort
---@field write fun(self: std_msgs.Int8MultiArray.Out, value: std_msgs.Int8MultiArray.Written)

---@class (exact) std_msgs.Int8MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.Int8MultiArray.OutOptions
---@field safe? std_msgs.Int8MultiArray.Written written when the component stops

---An in-port of std_msgs.MultiArrayDimension: One dimension of an array..
---@class std_msgs.MultiArrayDimension.In : InPort
---@field read fun(self: std_msgs.MultiArrayDimension.In): std_msgs.MultiArrayDimension

---An out-port of std_msgs.MultiArrayDimension: One dimension of an array..
---@class std_msgs.MultiArrayDimension.Out : OutPort
---@field write fun(self: std_msgs.MultiArrayDimension.Out, value: std_msgs.MultiArrayDimension.Written)

---@class (exact) std_msgs.MultiArrayDimension.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.MultiArrayDimension.OutOptions
---@field safe? std_msgs.MultiArrayDimension.Written written when the component stops

---An in-port of std_msgs.MultiArrayLayout: How the elements of an array are ordered..
---@class std_msgs.MultiArrayLayout.In : InPort
---@field read fun(self: std_msgs.MultiArrayLayout.In): std_msgs.MultiArrayLayout

---An out-port of std_msgs.MultiArrayLayout: How the elements of an array are ordered..
---@class std_msgs.MultiArrayLayout.Out : OutPort
---@field write fun(self: std_msgs.MultiArrayLayout.Out, value: std_msgs.MultiArrayLayout.Written)

---@class (exact) std_msgs.MultiArrayLayout.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.MultiArrayLayout.OutOptions
---@field safe? std_msgs.MultiArrayLayout.Written written when the component stops

---An in-port of std_msgs.String: One string..
---@class std_msgs.String.In : InPort
---@field read fun(self: std_msgs.String.In): std_msgs.String

---An out-port of std_msgs.String: One string..
---@class std_msgs.String.Out : OutPort
---@field write fun(self: std_msgs.String.Out, value: std_msgs.String.Written)

---@class (exact) std_msgs.String.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.String.OutOptions
---@field safe? std_msgs.String.Written written when the component stops

---An in-port of std_msgs.UInt16: One uint16..
---@class std_msgs.UInt16.In : InPort
---@field read fun(self: std_msgs.UInt16.In): std_msgs.UInt16

---An out-port of std_msgs.UInt16: One uint16..
---@class std_msgs.UInt16.Out : OutPort
---@field write fun(self: std_msgs.UInt16.Out, value: std_msgs.UInt16.Written)

---@class (exact) std_msgs.UInt16.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.UInt16.OutOptions
---@field safe? std_msgs.UInt16.Written written when the component stops

---An in-port of std_msgs.UInt16MultiArray: An array of uint16 in any number of dimensions..
---@class std_msgs.UInt16MultiArray.In : InPort
---@field read fun(self: std_msgs.UInt16MultiArray.In): std_msgs.UInt16MultiArray

---An out-port of std_msgs.UInt16MultiArray: An array of uint16 in any number of dimensions..
---@class std_msgs.UInt16MultiArray.Out : OutPort
---@field write fun(self: std_msgs.UInt16MultiArray.Out, value: std_msgs.UInt16MultiArray.Written)

---@class (exact) std_msgs.UInt16MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.UInt16MultiArray.OutOptions
---@field safe? std_msgs.UInt16MultiArray.Written written when the component stops

---An in-port of std_msgs.UInt32: One uint32..
---@class std_msgs.UInt32.In : InPort
---@field read fun(self: std_msgs.UInt32.In): std_msgs.UInt32

---An out-port of std_msgs.UInt32: One uint32..
---@class std_msgs.UInt32.Out : OutPort
---@field write fun(self: std_msgs.UInt32.Out, value: std_msgs.UInt32.Written)

---@class (exact) std_msgs.UInt32.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.UInt32.OutOptions
---@field safe? std_msgs.UInt32.Written written when the component stops

---An in-port of std_msgs.UInt32MultiArray: An array of uint32 in any number of dimensions..
---@class std_msgs.UInt32MultiArray.In : InPort
---@field read fun(self: std_msgs.UInt32MultiArray.In): std_msgs.UInt32MultiArray

---An out-port of std_msgs.UInt32MultiArray: An array of uint32 in any number of dimensions..
---@class std_msgs.UInt32MultiArray.Out : OutPort
---@field write fun(self: std_msgs.UInt32MultiArray.Out, value: std_msgs.UInt32MultiArray.Written)

---@class (exact) std_msgs.UInt32MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.UInt32MultiArray.OutOptions
---@field safe? std_msgs.UInt32MultiArray.Written written when the component stops

---An in-port of std_msgs.UInt64: One uint64..
---@class std_msgs.UInt64.In : InPort
---@field read fun(self: std_msgs.UInt64.In): std_msgs.UInt64

---An out-port of std_msgs.UInt64: One uint64..
---@class std_msgs.UInt64.Out : OutPort
---@field write fun(self: std_msgs.UInt64.Out, value: std_msgs.UInt64.Written)

---@class (exact) std_msgs.UInt64.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.UInt64.OutOptions
---@field safe? std_msgs.UInt64.Written written when the component stops

---An in-port of std_msgs.UInt64MultiArray: An array of uint64 in any number of dimensions..
---@class std_msgs.UInt64MultiArray.In : InPort
---@field read fun(self: std_msgs.UInt64MultiArray.In): std_msgs.UInt64MultiArray

---An out-port of std_msgs.UInt64MultiArray: An array of uint64 in any number of dimensions..
---@class std_msgs.UInt64MultiArray.Out : OutPort
---@field write fun(self: std_msgs.UInt64MultiArray.Out, value: std_msgs.UInt64MultiArray.Written)

---@class (exact) std_msgs.UInt64MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.UInt64MultiArray.OutOptions
---@field safe? std_msgs.UInt64MultiArray.Written written when the component stops

---An in-port of std_msgs.UInt8: One uint8..
---@class std_msgs.UInt8.In : InPort
---@field read fun(self: std_msgs.UInt8.In): std_msgs.UInt8

---An out-port of std_msgs.UInt8: One uint8..
---@class std_msgs.UInt8.Out : OutPort
---@field write fun(self: std_msgs.UInt8.Out, value: std_msgs.UInt8.Written)

---@class (exact) std_msgs.UInt8.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.UInt8.OutOptions
---@field safe? std_msgs.UInt8.Written written when the component stops

---An in-port of std_msgs.UInt8MultiArray: An array of uint8 in any number of dimensions..
---@class std_msgs.UInt8MultiArray.In : InPort
---@field read fun(self: std_msgs.UInt8MultiArray.In): std_msgs.UInt8MultiArray

---An out-port of std_msgs.UInt8MultiArray: An array of uint8 in any number of dimensions..
---@class std_msgs.UInt8MultiArray.Out : OutPort
---@field write fun(self: std_msgs.UInt8MultiArray.Out, value: std_msgs.UInt8MultiArray.Written)

---@class (exact) std_msgs.UInt8MultiArray.InOptions
---@field queue? integer how many unread messages are kept; then the oldest is dropped

---@class (exact) std_msgs.UInt8MultiArray.OutOptions
---@field safe? std_msgs.UInt8MultiArray.Written written when the component stops

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
---@overload fun(name: string, type: "TimedVelocity2D", doc?: string, options?: TimedVelocity2D.InOptions): TimedVelocity2D.In
---@overload fun(name: string, type: "TimedPose2D", doc?: string, options?: TimedPose2D.InOptions): TimedPose2D.In
---@overload fun(name: string, type: "TimedPose3D", doc?: string, options?: TimedPose3D.InOptions): TimedPose3D.In
---@overload fun(name: string, type: "RangeData", doc?: string, options?: RangeData.InOptions): RangeData.In
---@overload fun(name: string, type: "CameraImage", doc?: string, options?: CameraImage.InOptions): CameraImage.In
---@overload fun(name: string, type: "CameraIntrinsics", doc?: string, options?: CameraIntrinsics.InOptions): CameraIntrinsics.In
---@overload fun(name: string, type: "SeenMarkerSeq", doc?: string, options?: SeenMarkerSeq.InOptions): SeenMarkerSeq.In
---@overload fun(name: string, type: "builtin_interfaces/Duration", doc?: string, options?: builtin_interfaces.Duration.InOptions): builtin_interfaces.Duration.In
---@overload fun(name: string, type: "builtin_interfaces/Time", doc?: string, options?: builtin_interfaces.Time.InOptions): builtin_interfaces.Time.In
---@overload fun(name: string, type: "geometry_msgs/Accel", doc?: string, options?: geometry_msgs.Accel.InOptions): geometry_msgs.Accel.In
---@overload fun(name: string, type: "geometry_msgs/AccelStamped", doc?: string, options?: geometry_msgs.AccelStamped.InOptions): geometry_msgs.AccelStamped.In
---@overload fun(name: string, type: "geometry_msgs/AccelWithCovariance", doc?: string, options?: geometry_msgs.AccelWithCovariance.InOptions): geometry_msgs.AccelWithCovariance.In
---@overload fun(name: string, type: "geometry_msgs/AccelWithCovarianceStamped", doc?: string, options?: geometry_msgs.AccelWithCovarianceStamped.InOptions): geometry_msgs.AccelWithCovarianceStamped.In
---@overload fun(name: string, type: "geometry_msgs/Inertia", doc?: string, options?: geometry_msgs.Inertia.InOptions): geometry_msgs.Inertia.In
---@overload fun(name: string, type: "geometry_msgs/InertiaStamped", doc?: string, options?: geometry_msgs.InertiaStamped.InOptions): geometry_msgs.InertiaStamped.In
---@overload fun(name: string, type: "geometry_msgs/Point", doc?: string, options?: geometry_msgs.Point.InOptions): geometry_msgs.Point.In
---@overload fun(name: string, type: "geometry_msgs/Point32", doc?: string, options?: geometry_msgs.Point32.InOptions): geometry_msgs.Point32.In
---@overload fun(name: string, type: "geometry_msgs/PointStamped", doc?: string, options?: geometry_msgs.PointStamped.InOptions): geometry_msgs.PointStamped.In
---@overload fun(name: string, type: "geometry_msgs/Polygon", doc?: string, options?: geometry_msgs.Polygon.InOptions): geometry_msgs.Polygon.In
---@overload fun(name: string, type: "geometry_msgs/PolygonStamped", doc?: string, options?: geometry_msgs.PolygonStamped.InOptions): geometry_msgs.PolygonStamped.In
---@overload fun(name: string, type: "geometry_msgs/Pose", doc?: string, options?: geometry_msgs.Pose.InOptions): geometry_msgs.Pose.In
---@overload fun(name: string, type: "geometry_msgs/Pose2D", doc?: string, options?: geometry_msgs.Pose2D.InOptions): geometry_msgs.Pose2D.In
---@overload fun(name: string, type: "geometry_msgs/PoseArray", doc?: string, options?: geometry_msgs.PoseArray.InOptions): geometry_msgs.PoseArray.In
---@overload fun(name: string, type: "geometry_msgs/PoseStamped", doc?: string, options?: geometry_msgs.PoseStamped.InOptions): geometry_msgs.PoseStamped.In
---@overload fun(name: string, type: "geometry_msgs/PoseWithCovariance", doc?: string, options?: geometry_msgs.PoseWithCovariance.InOptions): geometry_msgs.PoseWithCovariance.In
---@overload fun(name: string, type: "geometry_msgs/PoseWithCovarianceStamped", doc?: string, options?: geometry_msgs.PoseWithCovarianceStamped.InOptions): geometry_msgs.PoseWithCovarianceStamped.In
---@overload fun(name: string, type: "geometry_msgs/Quaternion", doc?: string, options?: geometry_msgs.Quaternion.InOptions): geometry_msgs.Quaternion.In
---@overload fun(name: string, type: "geometry_msgs/QuaternionStamped", doc?: string, options?: geometry_msgs.QuaternionStamped.InOptions): geometry_msgs.QuaternionStamped.In
---@overload fun(name: string, type: "geometry_msgs/Transform", doc?: string, options?: geometry_msgs.Transform.InOptions): geometry_msgs.Transform.In
---@overload fun(name: string, type: "geometry_msgs/TransformStamped", doc?: string, options?: geometry_msgs.TransformStamped.InOptions): geometry_msgs.TransformStamped.In
---@overload fun(name: string, type: "geometry_msgs/Twist", doc?: string, options?: geometry_msgs.Twist.InOptions): geometry_msgs.Twist.In
---@overload fun(name: string, type: "geometry_msgs/TwistStamped", doc?: string, options?: geometry_msgs.TwistStamped.InOptions): geometry_msgs.TwistStamped.In
---@overload fun(name: string, type: "geometry_msgs/TwistWithCovariance", doc?: string, options?: geometry_msgs.TwistWithCovariance.InOptions): geometry_msgs.TwistWithCovariance.In
---@overload fun(name: string, type: "geometry_msgs/TwistWithCovarianceStamped", doc?: string, options?: geometry_msgs.TwistWithCovarianceStamped.InOptions): geometry_msgs.TwistWithCovarianceStamped.In
---@overload fun(name: string, type: "geometry_msgs/Vector3", doc?: string, options?: geometry_msgs.Vector3.InOptions): geometry_msgs.Vector3.In
---@overload fun(name: string, type: "geometry_msgs/Vector3Stamped", doc?: string, options?: geometry_msgs.Vector3Stamped.InOptions): geometry_msgs.Vector3Stamped.In
---@overload fun(name: string, type: "geometry_msgs/Wrench", doc?: string, options?: geometry_msgs.Wrench.InOptions): geometry_msgs.Wrench.In
---@overload fun(name: string, type: "geometry_msgs/WrenchStamped", doc?: string, options?: geometry_msgs.WrenchStamped.InOptions): geometry_msgs.WrenchStamped.In
---@overload fun(name: string, type: "nav_msgs/GridCells", doc?: string, options?: nav_msgs.GridCells.InOptions): nav_msgs.GridCells.In
---@overload fun(name: string, type: "nav_msgs/MapMetaData", doc?: string, options?: nav_msgs.MapMetaData.InOptions): nav_msgs.MapMetaData.In
---@overload fun(name: string, type: "nav_msgs/OccupancyGrid", doc?: string, options?: nav_msgs.OccupancyGrid.InOptions): nav_msgs.OccupancyGrid.In
---@overload fun(name: string, type: "nav_msgs/Odometry", doc?: string, options?: nav_msgs.Odometry.InOptions): nav_msgs.Odometry.In
---@overload fun(name: string, type: "nav_msgs/Path", doc?: string, options?: nav_msgs.Path.InOptions): nav_msgs.Path.In
---@overload fun(name: string, type: "raspimouse_msgs/Leds", doc?: string, options?: raspimouse_msgs.Leds.InOptions): raspimouse_msgs.Leds.In
---@overload fun(name: string, type: "raspimouse_msgs/LightSensors", doc?: string, options?: raspimouse_msgs.LightSensors.InOptions): raspimouse_msgs.LightSensors.In
---@overload fun(name: string, type: "raspimouse_msgs/Switches", doc?: string, options?: raspimouse_msgs.Switches.InOptions): raspimouse_msgs.Switches.In
---@overload fun(name: string, type: "sensor_msgs/BatteryState", doc?: string, options?: sensor_msgs.BatteryState.InOptions): sensor_msgs.BatteryState.In
---@overload fun(name: string, type: "sensor_msgs/CameraInfo", doc?: string, options?: sensor_msgs.CameraInfo.InOptions): sensor_msgs.CameraInfo.In
---@overload fun(name: string, type: "sensor_msgs/ChannelFloat32", doc?: string, options?: sensor_msgs.ChannelFloat32.InOptions): sensor_msgs.ChannelFloat32.In
---@overload fun(name: string, type: "sensor_msgs/CompressedImage", doc?: string, options?: sensor_msgs.CompressedImage.InOptions): sensor_msgs.CompressedImage.In
---@overload fun(name: string, type: "sensor_msgs/FluidPressure", doc?: string, options?: sensor_msgs.FluidPressure.InOptions): sensor_msgs.FluidPressure.In
---@overload fun(name: string, type: "sensor_msgs/Illuminance", doc?: string, options?: sensor_msgs.Illuminance.InOptions): sensor_msgs.Illuminance.In
---@overload fun(name: string, type: "sensor_msgs/Image", doc?: string, options?: sensor_msgs.Image.InOptions): sensor_msgs.Image.In
---@overload fun(name: string, type: "sensor_msgs/Imu", doc?: string, options?: sensor_msgs.Imu.InOptions): sensor_msgs.Imu.In
---@overload fun(name: string, type: "sensor_msgs/JointState", doc?: string, options?: sensor_msgs.JointState.InOptions): sensor_msgs.JointState.In
---@overload fun(name: string, type: "sensor_msgs/Joy", doc?: string, options?: sensor_msgs.Joy.InOptions): sensor_msgs.Joy.In
---@overload fun(name: string, type: "sensor_msgs/JoyFeedback", doc?: string, options?: sensor_msgs.JoyFeedback.InOptions): sensor_msgs.JoyFeedback.In
---@overload fun(name: string, type: "sensor_msgs/JoyFeedbackArray", doc?: string, options?: sensor_msgs.JoyFeedbackArray.InOptions): sensor_msgs.JoyFeedbackArray.In
---@overload fun(name: string, type: "sensor_msgs/LaserEcho", doc?: string, options?: sensor_msgs.LaserEcho.InOptions): sensor_msgs.LaserEcho.In
---@overload fun(name: string, type: "sensor_msgs/LaserScan", doc?: string, options?: sensor_msgs.LaserScan.InOptions): sensor_msgs.LaserScan.In
---@overload fun(name: string, type: "sensor_msgs/MagneticField", doc?: string, options?: sensor_msgs.MagneticField.InOptions): sensor_msgs.MagneticField.In
---@overload fun(name: string, type: "sensor_msgs/MultiDOFJointState", doc?: string, options?: sensor_msgs.MultiDOFJointState.InOptions): sensor_msgs.MultiDOFJointState.In
---@overload fun(name: string, type: "sensor_msgs/MultiEchoLaserScan", doc?: string, options?: sensor_msgs.MultiEchoLaserScan.InOptions): sensor_msgs.MultiEchoLaserScan.In
---@overload fun(name: string, type: "sensor_msgs/NavSatFix", doc?: string, options?: sensor_msgs.NavSatFix.InOptions): sensor_msgs.NavSatFix.In
---@overload fun(name: string, type: "sensor_msgs/NavSatStatus", doc?: string, options?: sensor_msgs.NavSatStatus.InOptions): sensor_msgs.NavSatStatus.In
---@overload fun(name: string, type: "sensor_msgs/PointCloud", doc?: string, options?: sensor_msgs.PointCloud.InOptions): sensor_msgs.PointCloud.In
---@overload fun(name: string, type: "sensor_msgs/PointCloud2", doc?: string, options?: sensor_msgs.PointCloud2.InOptions): sensor_msgs.PointCloud2.In
---@overload fun(name: string, type: "sensor_msgs/PointField", doc?: string, options?: sensor_msgs.PointField.InOptions): sensor_msgs.PointField.In
---@overload fun(name: string, type: "sensor_msgs/Range", doc?: string, options?: sensor_msgs.Range.InOptions): sensor_msgs.Range.In
---@overload fun(name: string, type: "sensor_msgs/RegionOfInterest", doc?: string, options?: sensor_msgs.RegionOfInterest.InOptions): sensor_msgs.RegionOfInterest.In
---@overload fun(name: string, type: "sensor_msgs/RelativeHumidity", doc?: string, options?: sensor_msgs.RelativeHumidity.InOptions): sensor_msgs.RelativeHumidity.In
---@overload fun(name: string, type: "sensor_msgs/Temperature", doc?: string, options?: sensor_msgs.Temperature.InOptions): sensor_msgs.Temperature.In
---@overload fun(name: string, type: "sensor_msgs/TimeReference", doc?: string, options?: sensor_msgs.TimeReference.InOptions): sensor_msgs.TimeReference.In
---@overload fun(name: string, type: "std_msgs/Bool", doc?: string, options?: std_msgs.Bool.InOptions): std_msgs.Bool.In
---@overload fun(name: string, type: "std_msgs/Byte", doc?: string, options?: std_msgs.Byte.InOptions): std_msgs.Byte.In
---@overload fun(name: string, type: "std_msgs/ByteMultiArray", doc?: string, options?: std_msgs.ByteMultiArray.InOptions): std_msgs.ByteMultiArray.In
---@overload fun(name: string, type: "std_msgs/Char", doc?: string, options?: std_msgs.Char.InOptions): std_msgs.Char.In
---@overload fun(name: string, type: "std_msgs/ColorRGBA", doc?: string, options?: std_msgs.ColorRGBA.InOptions): std_msgs.ColorRGBA.In
---@overload fun(name: string, type: "std_msgs/Empty", doc?: string, options?: std_msgs.Empty.InOptions): std_msgs.Empty.In
---@overload fun(name: string, type: "std_msgs/Float32", doc?: string, options?: std_msgs.Float32.InOptions): std_msgs.Float32.In
---@overload fun(name: string, type: "std_msgs/Float32MultiArray", doc?: string, options?: std_msgs.Float32MultiArray.InOptions): std_msgs.Float32MultiArray.In
---@overload fun(name: string, type: "std_msgs/Float64", doc?: string, options?: std_msgs.Float64.InOptions): std_msgs.Float64.In
---@overload fun(name: string, type: "std_msgs/Float64MultiArray", doc?: string, options?: std_msgs.Float64MultiArray.InOptions): std_msgs.Float64MultiArray.In
---@overload fun(name: string, type: "std_msgs/Header", doc?: string, options?: std_msgs.Header.InOptions): std_msgs.Header.In
---@overload fun(name: string, type: "std_msgs/Int16", doc?: string, options?: std_msgs.Int16.InOptions): std_msgs.Int16.In
---@overload fun(name: string, type: "std_msgs/Int16MultiArray", doc?: string, options?: std_msgs.Int16MultiArray.InOptions): std_msgs.Int16MultiArray.In
---@overload fun(name: string, type: "std_msgs/Int32", doc?: string, options?: std_msgs.Int32.InOptions): std_msgs.Int32.In
---@overload fun(name: string, type: "std_msgs/Int32MultiArray", doc?: string, options?: std_msgs.Int32MultiArray.InOptions): std_msgs.Int32MultiArray.In
---@overload fun(name: string, type: "std_msgs/Int64", doc?: string, options?: std_msgs.Int64.InOptions): std_msgs.Int64.In
---@overload fun(name: string, type: "std_msgs/Int64MultiArray", doc?: string, options?: std_msgs.Int64MultiArray.InOptions): std_msgs.Int64MultiArray.In
---@overload fun(name: string, type: "std_msgs/Int8", doc?: string, options?: std_msgs.Int8.InOptions): std_msgs.Int8.In
---@overload fun(name: string, type: "std_msgs/Int8MultiArray", doc?: string, options?: std_msgs.Int8MultiArray.InOptions): std_msgs.Int8MultiArray.In
---@overload fun(name: string, type: "std_msgs/MultiArrayDimension", doc?: string, options?: std_msgs.MultiArrayDimension.InOptions): std_msgs.MultiArrayDimension.In
---@overload fun(name: string, type: "std_msgs/MultiArrayLayout", doc?: string, options?: std_msgs.MultiArrayLayout.InOptions): std_msgs.MultiArrayLayout.In
---@overload fun(name: string, type: "std_msgs/String", doc?: string, options?: std_msgs.String.InOptions): std_msgs.String.In
---@overload fun(name: string, type: "std_msgs/UInt16", doc?: string, options?: std_msgs.UInt16.InOptions): std_msgs.UInt16.In
---@overload fun(name: string, type: "std_msgs/UInt16MultiArray", doc?: string, options?: std_msgs.UInt16MultiArray.InOptions): std_msgs.UInt16MultiArray.In
---@overload fun(name: string, type: "std_msgs/UInt32", doc?: string, options?: std_msgs.UInt32.InOptions): std_msgs.UInt32.In
---@overload fun(name: string, type: "std_msgs/UInt32MultiArray", doc?: string, options?: std_msgs.UInt32MultiArray.InOptions): std_msgs.UInt32MultiArray.In
---@overload fun(name: string, type: "std_msgs/UInt64", doc?: string, options?: std_msgs.UInt64.InOptions): std_msgs.UInt64.In
---@overload fun(name: string, type: "std_msgs/UInt64MultiArray", doc?: string, options?: std_msgs.UInt64MultiArray.InOptions): std_msgs.UInt64MultiArray.In
---@overload fun(name: string, type: "std_msgs/UInt8", doc?: string, options?: std_msgs.UInt8.InOptions): std_msgs.UInt8.In
---@overload fun(name: string, type: "std_msgs/UInt8MultiArray", doc?: string, options?: std_msgs.UInt8MultiArray.InOptions): std_msgs.UInt8MultiArray.In
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
---@overload fun(name: string, type: "TimedVelocity2D", doc?: string, options?: TimedVelocity2D.OutOptions): TimedVelocity2D.Out
---@overload fun(name: string, type: "TimedPose2D", doc?: string, options?: TimedPose2D.OutOptions): TimedPose2D.Out
---@overload fun(name: string, type: "TimedPose3D", doc?: string, options?: TimedPose3D.OutOptions): TimedPose3D.Out
---@overload fun(name: string, type: "RangeData", doc?: string, options?: RangeData.OutOptions): RangeData.Out
---@overload fun(name: string, type: "CameraImage", doc?: string, options?: CameraImage.OutOptions): CameraImage.Out
---@overload fun(name: string, type: "CameraIntrinsics", doc?: string, options?: CameraIntrinsics.OutOptions): CameraIntrinsics.Out
---@overload fun(name: string, type: "SeenMarkerSeq", doc?: string, options?: SeenMarkerSeq.OutOptions): SeenMarkerSeq.Out
---@overload fun(name: string, type: "builtin_interfaces/Duration", doc?: string, options?: builtin_interfaces.Duration.OutOptions): builtin_interfaces.Duration.Out
---@overload fun(name: string, type: "builtin_interfaces/Time", doc?: string, options?: builtin_interfaces.Time.OutOptions): builtin_interfaces.Time.Out
---@overload fun(name: string, type: "geometry_msgs/Accel", doc?: string, options?: geometry_msgs.Accel.OutOptions): geometry_msgs.Accel.Out
---@overload fun(name: string, type: "geometry_msgs/AccelStamped", doc?: string, options?: geometry_msgs.AccelStamped.OutOptions): geometry_msgs.AccelStamped.Out
---@overload fun(name: string, type: "geometry_msgs/AccelWithCovariance", doc?: string, options?: geometry_msgs.AccelWithCovariance.OutOptions): geometry_msgs.AccelWithCovariance.Out
---@overload fun(name: string, type: "geometry_msgs/AccelWithCovarianceStamped", doc?: string, options?: geometry_msgs.AccelWithCovarianceStamped.OutOptions): geometry_msgs.AccelWithCovarianceStamped.Out
---@overload fun(name: string, type: "geometry_msgs/Inertia", doc?: string, options?: geometry_msgs.Inertia.OutOptions): geometry_msgs.Inertia.Out
---@overload fun(name: string, type: "geometry_msgs/InertiaStamped", doc?: string, options?: geometry_msgs.InertiaStamped.OutOptions): geometry_msgs.InertiaStamped.Out
---@overload fun(name: string, type: "geometry_msgs/Point", doc?: string, options?: geometry_msgs.Point.OutOptions): geometry_msgs.Point.Out
---@overload fun(name: string, type: "geometry_msgs/Point32", doc?: string, options?: geometry_msgs.Point32.OutOptions): geometry_msgs.Point32.Out
---@overload fun(name: string, type: "geometry_msgs/PointStamped", doc?: string, options?: geometry_msgs.PointStamped.OutOptions): geometry_msgs.PointStamped.Out
---@overload fun(name: string, type: "geometry_msgs/Polygon", doc?: string, options?: geometry_msgs.Polygon.OutOptions): geometry_msgs.Polygon.Out
---@overload fun(name: string, type: "geometry_msgs/PolygonStamped", doc?: string, options?: geometry_msgs.PolygonStamped.OutOptions): geometry_msgs.PolygonStamped.Out
---@overload fun(name: string, type: "geometry_msgs/Pose", doc?: string, options?: geometry_msgs.Pose.OutOptions): geometry_msgs.Pose.Out
---@overload fun(name: string, type: "geometry_msgs/Pose2D", doc?: string, options?: geometry_msgs.Pose2D.OutOptions): geometry_msgs.Pose2D.Out
---@overload fun(name: string, type: "geometry_msgs/PoseArray", doc?: string, options?: geometry_msgs.PoseArray.OutOptions): geometry_msgs.PoseArray.Out
---@overload fun(name: string, type: "geometry_msgs/PoseStamped", doc?: string, options?: geometry_msgs.PoseStamped.OutOptions): geometry_msgs.PoseStamped.Out
---@overload fun(name: string, type: "geometry_msgs/PoseWithCovariance", doc?: string, options?: geometry_msgs.PoseWithCovariance.OutOptions): geometry_msgs.PoseWithCovariance.Out
---@overload fun(name: string, type: "geometry_msgs/PoseWithCovarianceStamped", doc?: string, options?: geometry_msgs.PoseWithCovarianceStamped.OutOptions): geometry_msgs.PoseWithCovarianceStamped.Out
---@overload fun(name: string, type: "geometry_msgs/Quaternion", doc?: string, options?: geometry_msgs.Quaternion.OutOptions): geometry_msgs.Quaternion.Out
---@overload fun(name: string, type: "geometry_msgs/QuaternionStamped", doc?: string, options?: geometry_msgs.QuaternionStamped.OutOptions): geometry_msgs.QuaternionStamped.Out
---@overload fun(name: string, type: "geometry_msgs/Transform", doc?: string, options?: geometry_msgs.Transform.OutOptions): geometry_msgs.Transform.Out
---@overload fun(name: string, type: "geometry_msgs/TransformStamped", doc?: string, options?: geometry_msgs.TransformStamped.OutOptions): geometry_msgs.TransformStamped.Out
---@overload fun(name: string, type: "geometry_msgs/Twist", doc?: string, options?: geometry_msgs.Twist.OutOptions): geometry_msgs.Twist.Out
---@overload fun(name: string, type: "geometry_msgs/TwistStamped", doc?: string, options?: geometry_msgs.TwistStamped.OutOptions): geometry_msgs.TwistStamped.Out
---@overload fun(name: string, type: "geometry_msgs/TwistWithCovariance", doc?: string, options?: geometry_msgs.TwistWithCovariance.OutOptions): geometry_msgs.TwistWithCovariance.Out
---@overload fun(name: string, type: "geometry_msgs/TwistWithCovarianceStamped", doc?: string, options?: geometry_msgs.TwistWithCovarianceStamped.OutOptions): geometry_msgs.TwistWithCovarianceStamped.Out
---@overload fun(name: string, type: "geometry_msgs/Vector3", doc?: string, options?: geometry_msgs.Vector3.OutOptions): geometry_msgs.Vector3.Out
---@overload fun(name: string, type: "geometry_msgs/Vector3Stamped", doc?: string, options?: geometry_msgs.Vector3Stamped.OutOptions): geometry_msgs.Vector3Stamped.Out
---@overload fun(name: string, type: "geometry_msgs/Wrench", doc?: string, options?: geometry_msgs.Wrench.OutOptions): geometry_msgs.Wrench.Out
---@overload fun(name: string, type: "geometry_msgs/WrenchStamped", doc?: string, options?: geometry_msgs.WrenchStamped.OutOptions): geometry_msgs.WrenchStamped.Out
---@overload fun(name: string, type: "nav_msgs/GridCells", doc?: string, options?: nav_msgs.GridCells.OutOptions): nav_msgs.GridCells.Out
---@overload fun(name: string, type: "nav_msgs/MapMetaData", doc?: string, options?: nav_msgs.MapMetaData.OutOptions): nav_msgs.MapMetaData.Out
---@overload fun(name: string, type: "nav_msgs/OccupancyGrid", doc?: string, options?: nav_msgs.OccupancyGrid.OutOptions): nav_msgs.OccupancyGrid.Out
---@overload fun(name: string, type: "nav_msgs/Odometry", doc?: string, options?: nav_msgs.Odometry.OutOptions): nav_msgs.Odometry.Out
---@overload fun(name: string, type: "nav_msgs/Path", doc?: string, options?: nav_msgs.Path.OutOptions): nav_msgs.Path.Out
---@overload fun(name: string, type: "raspimouse_msgs/Leds", doc?: string, options?: raspimouse_msgs.Leds.OutOptions): raspimouse_msgs.Leds.Out
---@overload fun(name: string, type: "raspimouse_msgs/LightSensors", doc?: string, options?: raspimouse_msgs.LightSensors.OutOptions): raspimouse_msgs.LightSensors.Out
---@overload fun(name: string, type: "raspimouse_msgs/Switches", doc?: string, options?: raspimouse_msgs.Switches.OutOptions): raspimouse_msgs.Switches.Out
---@overload fun(name: string, type: "sensor_msgs/BatteryState", doc?: string, options?: sensor_msgs.BatteryState.OutOptions): sensor_msgs.BatteryState.Out
---@overload fun(name: string, type: "sensor_msgs/CameraInfo", doc?: string, options?: sensor_msgs.CameraInfo.OutOptions): sensor_msgs.CameraInfo.Out
---@overload fun(name: string, type: "sensor_msgs/ChannelFloat32", doc?: string, options?: sensor_msgs.ChannelFloat32.OutOptions): sensor_msgs.ChannelFloat32.Out
---@overload fun(name: string, type: "sensor_msgs/CompressedImage", doc?: string, options?: sensor_msgs.CompressedImage.OutOptions): sensor_msgs.CompressedImage.Out
---@overload fun(name: string, type: "sensor_msgs/FluidPressure", doc?: string, options?: sensor_msgs.FluidPressure.OutOptions): sensor_msgs.FluidPressure.Out
---@overload fun(name: string, type: "sensor_msgs/Illuminance", doc?: string, options?: sensor_msgs.Illuminance.OutOptions): sensor_msgs.Illuminance.Out
---@overload fun(name: string, type: "sensor_msgs/Image", doc?: string, options?: sensor_msgs.Image.OutOptions): sensor_msgs.Image.Out
---@overload fun(name: string, type: "sensor_msgs/Imu", doc?: string, options?: sensor_msgs.Imu.OutOptions): sensor_msgs.Imu.Out
---@overload fun(name: string, type: "sensor_msgs/JointState", doc?: string, options?: sensor_msgs.JointState.OutOptions): sensor_msgs.JointState.Out
---@overload fun(name: string, type: "sensor_msgs/Joy", doc?: string, options?: sensor_msgs.Joy.OutOptions): sensor_msgs.Joy.Out
---@overload fun(name: string, type: "sensor_msgs/JoyFeedback", doc?: string, options?: sensor_msgs.JoyFeedback.OutOptions): sensor_msgs.JoyFeedback.Out
---@overload fun(name: string, type: "sensor_msgs/JoyFeedbackArray", doc?: string, options?: sensor_msgs.JoyFeedbackArray.OutOptions): sensor_msgs.JoyFeedbackArray.Out
---@overload fun(name: string, type: "sensor_msgs/LaserEcho", doc?: string, options?: sensor_msgs.LaserEcho.OutOptions): sensor_msgs.LaserEcho.Out
---@overload fun(name: string, type: "sensor_msgs/LaserScan", doc?: string, options?: sensor_msgs.LaserScan.OutOptions): sensor_msgs.LaserScan.Out
---@overload fun(name: string, type: "sensor_msgs/MagneticField", doc?: string, options?: sensor_msgs.MagneticField.OutOptions): sensor_msgs.MagneticField.Out
---@overload fun(name: string, type: "sensor_msgs/MultiDOFJointState", doc?: string, options?: sensor_msgs.MultiDOFJointState.OutOptions): sensor_msgs.MultiDOFJointState.Out
---@overload fun(name: string, type: "sensor_msgs/MultiEchoLaserScan", doc?: string, options?: sensor_msgs.MultiEchoLaserScan.OutOptions): sensor_msgs.MultiEchoLaserScan.Out
---@overload fun(name: string, type: "sensor_msgs/NavSatFix", doc?: string, options?: sensor_msgs.NavSatFix.OutOptions): sensor_msgs.NavSatFix.Out
---@overload fun(name: string, type: "sensor_msgs/NavSatStatus", doc?: string, options?: sensor_msgs.NavSatStatus.OutOptions): sensor_msgs.NavSatStatus.Out
---@overload fun(name: string, type: "sensor_msgs/PointCloud", doc?: string, options?: sensor_msgs.PointCloud.OutOptions): sensor_msgs.PointCloud.Out
---@overload fun(name: string, type: "sensor_msgs/PointCloud2", doc?: string, options?: sensor_msgs.PointCloud2.OutOptions): sensor_msgs.PointCloud2.Out
---@overload fun(name: string, type: "sensor_msgs/PointField", doc?: string, options?: sensor_msgs.PointField.OutOptions): sensor_msgs.PointField.Out
---@overload fun(name: string, type: "sensor_msgs/Range", doc?: string, options?: sensor_msgs.Range.OutOptions): sensor_msgs.Range.Out
---@overload fun(name: string, type: "sensor_msgs/RegionOfInterest", doc?: string, options?: sensor_msgs.RegionOfInterest.OutOptions): sensor_msgs.RegionOfInterest.Out
---@overload fun(name: string, type: "sensor_msgs/RelativeHumidity", doc?: string, options?: sensor_msgs.RelativeHumidity.OutOptions): sensor_msgs.RelativeHumidity.Out
---@overload fun(name: string, type: "sensor_msgs/Temperature", doc?: string, options?: sensor_msgs.Temperature.OutOptions): sensor_msgs.Temperature.Out
---@overload fun(name: string, type: "sensor_msgs/TimeReference", doc?: string, options?: sensor_msgs.TimeReference.OutOptions): sensor_msgs.TimeReference.Out
---@overload fun(name: string, type: "std_msgs/Bool", doc?: string, options?: std_msgs.Bool.OutOptions): std_msgs.Bool.Out
---@overload fun(name: string, type: "std_msgs/Byte", doc?: string, options?: std_msgs.Byte.OutOptions): std_msgs.Byte.Out
---@overload fun(name: string, type: "std_msgs/ByteMultiArray", doc?: string, options?: std_msgs.ByteMultiArray.OutOptions): std_msgs.ByteMultiArray.Out
---@overload fun(name: string, type: "std_msgs/Char", doc?: string, options?: std_msgs.Char.OutOptions): std_msgs.Char.Out
---@overload fun(name: string, type: "std_msgs/ColorRGBA", doc?: string, options?: std_msgs.ColorRGBA.OutOptions): std_msgs.ColorRGBA.Out
---@overload fun(name: string, type: "std_msgs/Empty", doc?: string, options?: std_msgs.Empty.OutOptions): std_msgs.Empty.Out
---@overload fun(name: string, type: "std_msgs/Float32", doc?: string, options?: std_msgs.Float32.OutOptions): std_msgs.Float32.Out
---@overload fun(name: string, type: "std_msgs/Float32MultiArray", doc?: string, options?: std_msgs.Float32MultiArray.OutOptions): std_msgs.Float32MultiArray.Out
---@overload fun(name: string, type: "std_msgs/Float64", doc?: string, options?: std_msgs.Float64.OutOptions): std_msgs.Float64.Out
---@overload fun(name: string, type: "std_msgs/Float64MultiArray", doc?: string, options?: std_msgs.Float64MultiArray.OutOptions): std_msgs.Float64MultiArray.Out
---@overload fun(name: string, type: "std_msgs/Header", doc?: string, options?: std_msgs.Header.OutOptions): std_msgs.Header.Out
---@overload fun(name: string, type: "std_msgs/Int16", doc?: string, options?: std_msgs.Int16.OutOptions): std_msgs.Int16.Out
---@overload fun(name: string, type: "std_msgs/Int16MultiArray", doc?: string, options?: std_msgs.Int16MultiArray.OutOptions): std_msgs.Int16MultiArray.Out
---@overload fun(name: string, type: "std_msgs/Int32", doc?: string, options?: std_msgs.Int32.OutOptions): std_msgs.Int32.Out
---@overload fun(name: string, type: "std_msgs/Int32MultiArray", doc?: string, options?: std_msgs.Int32MultiArray.OutOptions): std_msgs.Int32MultiArray.Out
---@overload fun(name: string, type: "std_msgs/Int64", doc?: string, options?: std_msgs.Int64.OutOptions): std_msgs.Int64.Out
---@overload fun(name: string, type: "std_msgs/Int64MultiArray", doc?: string, options?: std_msgs.Int64MultiArray.OutOptions): std_msgs.Int64MultiArray.Out
---@overload fun(name: string, type: "std_msgs/Int8", doc?: string, options?: std_msgs.Int8.OutOptions): std_msgs.Int8.Out
---@overload fun(name: string, type: "std_msgs/Int8MultiArray", doc?: string, options?: std_msgs.Int8MultiArray.OutOptions): std_msgs.Int8MultiArray.Out
---@overload fun(name: string, type: "std_msgs/MultiArrayDimension", doc?: string, options?: std_msgs.MultiArrayDimension.OutOptions): std_msgs.MultiArrayDimension.Out
---@overload fun(name: string, type: "std_msgs/MultiArrayLayout", doc?: string, options?: std_msgs.MultiArrayLayout.OutOptions): std_msgs.MultiArrayLayout.Out
---@overload fun(name: string, type: "std_msgs/String", doc?: string, options?: std_msgs.String.OutOptions): std_msgs.String.Out
---@overload fun(name: string, type: "std_msgs/UInt16", doc?: string, options?: std_msgs.UInt16.OutOptions): std_msgs.UInt16.Out
---@overload fun(name: string, type: "std_msgs/UInt16MultiArray", doc?: string, options?: std_msgs.UInt16MultiArray.OutOptions): std_msgs.UInt16MultiArray.Out
---@overload fun(name: string, type: "std_msgs/UInt32", doc?: string, options?: std_msgs.UInt32.OutOptions): std_msgs.UInt32.Out
---@overload fun(name: string, type: "std_msgs/UInt32MultiArray", doc?: string, options?: std_msgs.UInt32MultiArray.OutOptions): std_msgs.UInt32MultiArray.Out
---@overload fun(name: string, type: "std_msgs/UInt64", doc?: string, options?: std_msgs.UInt64.OutOptions): std_msgs.UInt64.Out
---@overload fun(name: string, type: "std_msgs/UInt64MultiArray", doc?: string, options?: std_msgs.UInt64MultiArray.OutOptions): std_msgs.UInt64MultiArray.Out
---@overload fun(name: string, type: "std_msgs/UInt8", doc?: string, options?: std_msgs.UInt8.OutOptions): std_msgs.UInt8.Out
---@overload fun(name: string, type: "std_msgs/UInt8MultiArray", doc?: string, options?: std_msgs.UInt8MultiArray.OutOptions): std_msgs.UInt8MultiArray.Out
function output(name, type, doc, options) end

---@alias ParameterValue boolean|integer|number|string|boolean[]|integer[]|number[]|string[]

---@class (exact) ParameterOptions
---@field min? number smallest value; of each element of an array (of numbers, arrays of numbers)
---@field max? number largest value; of each element of an array (of numbers, arrays of numbers)
---@field step? number of the widget only (of numbers, arrays of numbers)
---@field widget? "slider"|"spin"|"radio"|"checkbox"|"ordered_list"|"text" how it is shown for a person to change: a slider needs both bounds, radio needs choices; a checkbox shows a truth value, or an array as a part of its choices; an ordered list shows an array of its choices
---@field unit? string for example "m/s"
---@field doc? string what it means
---@field choices? ParameterValue[] the values that may be chosen; without: all within the bounds
---@field min_size? integer fewest elements (of arrays of numbers, other arrays)
---@field max_size? integer most elements (of arrays of numbers, other arrays)

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
---@field cell? number [m] distance of two walls, from middle to middle
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
---@field pose? { x?: number, y?: number, heading?: number } where it starts
---@field limits? LimitChangesFields instead of the model's
---@field backend? string "sim": simulated with --hw as well; or the driver that --hw uses
---@field calibrated? boolean use `NAME.calibration.lua` beside this file also in simulation
---@field odometry_at_pose? boolean its odometry starts at `pose`, in the arena's coordinates; otherwise at 0, 0, 0
---@field active? boolean whether it is activated at the start
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
---@field config? table<string, ParameterValue> values of its parameters
---@field sets? table<string, table<string, ParameterValue>> values of parameters that are chosen together, by the set's name
---@field set? string the parameter set in use; omitted parameters have the values of `config`
---@field rate? number [Hz] executions a second, at most the tick's
---@field active? boolean whether it is activated at the start

---@class (exact) ComponentFields
---@field type string a native component's type, for example "Camera"
---@field config? table<string, ParameterValue> values of its parameters
---@field rate? number [Hz] executions a second, at most the tick's
---@field on? string the robot that carries it
---@field at? number[] [m] on that robot, from the middle of the wheels' axis on the floor
---@field yaw? number [rad] on that robot, counter-clockwise
---@field backend? string "sim": simulated with --hw as well
---@field active? boolean whether it is activated at the start
---@field calibration? string a Camera's: the file that ROS's camera_calibration wrote, for example "ost.yaml"

---@class (exact) PhysicsFields
---@field step number [s] of time that the physics advances at once; a tick is a whole number of them

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
---@field frame? string of the message's header

---@class (exact) RtmFields
---@field nameserver? string "HOST:PORT" of the CORBA name service
---@field export? string|string[] the components that appear there
---@field interface? string this computer's address, at which others reach them; by default only this computer reaches them
---@field rename? table<string, ParameterValue> what a port is called there, by `"name.port"`

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
---@field hardware_limits? LimitsFields on the real robot, until it is calibrated
---@field needs? string|string[] sensors that it needs to drive: it stops if one of them gave no value for 0.3 s
---@field port? string|string[] devices of the real robot's left and right motor

---@class (exact) SensorFields
---@field kind? "range"|"button"|"touch"|"gyro"|"color"|"reflect"|"ambient"|"scan"|"imu" what it measures
---@field at? number[] [m] from the hull's centre
---@field yaw? number [rad] where it looks, counter-clockwise
---@field on? string the servo that carries it, instead of the hull
---@field range? number [m] it sees no farther (of range, scan)
---@field minimum? number [m] it sees no nearer (of range, scan)
---@field cone? number [rad] full opening angle, 0: a single ray; of a scan, its field of view (of range, scan)
---@field rays? integer rays in the cone: the nearest hit counts; a scan gives the distance of each, from right to left (of range, scan)
---@field noise? number standard deviation, in the value's unit; of an imu, of its rates in rad/s (of range, gyro, reflect, ambient, scan, imu)
---@field acceleration_noise? number [m/s^2] standard deviation of its accelerations (of imu)
---@field table? string|number[][] a CSV file with the columns `distance_m` and `value` beside the robot file, or points `{ { 0.01, 1394 }, ... }`. Exact at its points; nearer than the first the value goes on as a power law, farther than the last it fades to `nothing` at `range` (of range)
---@field response? fun(distance: number): number instead of `table`: it is sampled when the file is read; `response(math.huge)` is the value with nothing in sight (of range)
---@field nothing? number the value with nothing in sight (of range)
---@field min_value? number bound of the value (of range)
---@field max_value? number bound of the value (of range)
---@field drift? number [rad/s] (of gyro)
---@field max_rate? number [rad/s] it can follow; 0: any (of gyro, imu)
---@field travel? number [m] until it closes (of touch)
---@field level? number light of the simulated room, from 0 (dark) to 100 (of ambient)
---@field port? string which device of the real robot it is

---@class (exact) ActuatorFields
---@field kind? "leds"|"buzzer"|"servo"|"screen"|"speaker"
---@field count? integer how many (of leds)
---@field max_rate? number [rad/s] 0: any (of servo)
---@field speed? number [rad/s] initial speed, the default of the robot's parameter `NAME_speed`. 0: as fast as possible, without this parameter (of servo)
---@field minimum? number [rad] (of servo)
---@field maximum? number [rad] equal to `minimum`: unlimited (of servo)
---@field at? number[] [m] its axis, from the hull's centre (of servo)
---@field port? string which device of the real robot it is

---@class (exact) PortFields
---@field type? string a message type
---@field from? string|string[] a sensor, a list of them, `"velocity"` (measured at the wheels) or `"odometry"` (of out-port)
---@field to? string|string[] `"drive"`, `"odometry"` (sets it) or an actuator (of in-port)
---@field doc? string documentation for editors and the console
---@field rate? number [Hz] messages a second; 0: one each tick (of out-port)
---@field quantity? "value"|"distance"|"rate"|"acceleration" `"distance"`: metres instead of a range sensor's value; `"rate"`: of a gyro instead of its angle, of an imu its three rates; `"acceleration"`: of an imu its three accelerations (of out-port)
---@field queue? integer how many unread messages are kept; 0: the latest (of in-port)
---@field silence? "hold"|"off" after 0.5 s without a message: the actuator holds or goes off (of in-port)

---@class (exact) HardwareFields
---@field driver? string "raspimouse" or "ev3"
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
---@field heading? number [rad] counter-clockwise, 0 looks along x

---@class (exact) MarkerPoseFields
---@field x? number [m]
---@field y? number [m]
---@field z? number [m] of its centre
---@field heading? number [rad] into which it looks

---@class (exact) VelocityConstraintFields
---@field vx? number [m/s] along the robot's x axis
---@field vy? number [m/s] along the robot's y axis
---@field va? number [rad/s] yaw rate, counter-clockwise
---@field seconds? number [s] how long (of s:disturb)

---@class (exact) HoldOptions
---@field take? boolean even if another actor holds the port

---@class (exact) CalibrationFields
---@field robot string its name in the system
---@field model string that it was measured with
---@field serial? string number of its computer: on another one the file is refused
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
---@field seeds? integer how many runs are made of each combination, each with its own seed
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
---@field file? string its script, found as a system file finds one
---@field text? string the script itself

---@class (exact) RecordedOptions
---@field map? table<string, string> names of ports for topics, `{ ["/scan"] = "robot.scan" }`; only for recordings of other programs and of real robots

---@class (exact) JudgeOptions
---@field behavior string its file, or its name
---@field component? string the recorded component
---@field run string the recording or journal
---@field map? table<string, string> ports of topics, `{ ["/scan"] = "keeper.rays" }`: needed for recordings of other programs
---@field tolerance? number largest difference of equal numbers

---Declares a parameter, read as `config.name`. Its type follows the default: `30` integer, `0.0` number.
---@param name string
---@param default ParameterValue
---@param options? ParameterOptions
function param(name, default, options) end

---Defines a message type, in a file of its own: `return message "Obstacle" { { "distance", "double", unit = "m" } }`.
---@param name string that of the file: `light_sensors.lua` defines LightSensors
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

---Survives a reload: plain data only.
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

---Shows a value from inside as `component.probes.name`: the last of a tick counts. Recorded, and no part of the trace.
---@param name string
---@param value number|boolean|string|table a table is flat, with at most 64 entries
function probe(name, value) end

---Declares what is done one after the other: it starts on activation and runs in slices, from one wait to the next.
---@param name string
---@param fn fun()
---@param options? TaskOptions
function task(name, fn, options) end

---Starts a task at the next execution; an error while it is under way.
---@param name string
function start(name) end

---Ends a task, its `<close>` variables included. Returns whether it was under way.
---@param name string
---@return boolean
function cancel(name) end

---Waits so long, in a task only. Returns the time that has passed [s].
---@param seconds number
---@return number
function wait(seconds) end

---Waits until `condition()` is true, in a task only: looks at once and then once an execution. Returns false when it was
---not within the time that is given.
---@param condition fun(): any
---@param options? WaitOptions
---@return boolean
function wait_until(condition, options) end

---Before the first execution after an activation.
function on_activated() end

---In every tick, or at the `rate` of the system file.
function on_execute() end

---When it is deactivated, removed, or the run ends.
function on_deactivated() end

---Once, when an error has stopped it. May not write velocities.
function on_aborting() end

---In every tick while it is in ERROR. May not write velocities.
function on_error() end

---When somebody resets it; afterwards it is INACTIVE.
function on_reset() end

---When a new version of the file takes over.
---@param old_version integer
function on_reload(old_version) end

---@class Thing

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
---@param fields MazeFields
---@return Thing
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

---This system is a host among others. Without the word nothing of it is on the network.
---@param fields NetworkFields
function network(fields) end

---This system is a node among those of ROS 2.
---@param fields RosFields
function ros(fields) end

---Components that are visible to OpenRTM-aist components and can be connected to them.
---@param fields RtmFields
function rtm(fields) end

---A value that `--set name=value` gives instead of the default.
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

---Of everything random in the run.
---@param n integer
function seed(n) end

---A model of robot: `return robot_model { ... }` is a robot file.
---@param fields RobotModelFields
---@return table
function robot_model(fields) end

---A port as seen from outside: reading it here does not consume messages.
---@class Port
---@field age number how long ago its stamp was [s]; math.huge before the first message
---@field connected boolean whether another port is connected to it
---@field count integer messages since the start
---@field direction "in"|"out" whether its component reads or writes it
---@field doc string its description
---@field drop fun(self: Port) no message gets through until release
---@field freeze fun(self: Port) the present value is repeated until release
---@field hold fun(self: Port, value: any, options?: HoldOptions) only this value gets through until release
---@field holder string? the actor that holds, drops or freezes it, or nil
---@field inject fun(self: Port, value: any) one message, as from a connection
---@field name string its name
---@field note string a note from its robot, for example that commands are ignored
---@field override string "held", "dropped", "frozen" or ""
---@field path string "name.port"
---@field peers string[] the ports at its other end
---@field release fun(self: Port) ends what hold, drop and freeze began
---@field stale boolean whether it is overdue: no message came for three periods of its sender, at least 0.1 s, or for 0.5 s if the sender declares no rate
---@field tm number its stamp [s], 0 before the first message
---@field type MessageType its message type
---@field unread boolean of an in-port: whether it has a message that its component has not read
---@field value any a copy of the latest message; reading it here does not consume it. Before the first message, the zero value of its type
---@field write fun(self: Port, value: any) an out-port: published as if its component had written it; an in-port: as inject

---@class Component
---@field activate fun(self: Component): string makes it ACTIVE; gives the status that follows
---@field buzzer integer of robots: tone of its buzzer [Hz], 0 for silence
---@field collided boolean of robots: whether it touches something
---@field commands string[] the names of its commands
---@field config table<string, ParameterValue> its parameters, read and written within their bounds
---@field deactivate fun(self: Component): string makes it INACTIVE; gives the status that follows
---@field disturb fun(self: Component, velocities?: VelocityConstraintFields) of robots: forces these velocities on the robot; without velocities it moves freely again
---@field error string? in ERROR: the error; otherwise nil
---@field failure { text: string, tm: number, file?: string, line?: integer, frames?: { file: string, line: integer, name?: string, locals: table }[] }? in ERROR: the error, its time [s], its line, and the functions that were running, the innermost first, each with file, line, name and locals; otherwise nil
---@field leds boolean[] of robots: which of its lights are on
---@field limits table<string, number> of robots: the highest speeds and accelerations that it obeys
---@field name string its name
---@field ports table<string, Port> its ports by name
---@field press fun(self: Component, sensor: string, pressed?: boolean) of robots: presses a button or touch sensor; with false releases it
---@field probes table<string, ProbeView> the values of `probe` calls in its script: value, tm and age
---@field rate number executions a second [Hz]
---@field reset fun(self: Component): string takes it out of ERROR; gives the status that follows
---@field said string[] of robots: the last 100 texts sent to its speaker
---@field set string? the named set of parameters in use, or nil
---@field sets string[] the names of its sets of parameters
---@field state table a copy of its script's `state`
---@field status "INACTIVE"|"ACTIVE"|"ERROR" "INACTIVE", "ACTIVE" or "ERROR"
---@field tasks table<string, TaskView> its tasks: status, since, waiting and line of each
---@field teleport fun(self: Component, pose: PoseFields) of robots: moves it to a pose, at rest
---@field touching string? of robots: what it touches, or nil
---@field truth { pose: Pose2D, velocity: Velocity2D, height: number, tilt: number } of robots: its true state in simulation: pose, velocity, height, tilt
---@field type string its component type
---@field use fun(self: Component, set: string): string switches to a named set of parameters
---@field version integer counts the versions of its script, from 1
---@field [string] any its ports and commands

---@class TaskView
---@field status "inactive"|"ready"|"waiting"|"finished"|"cancelled"|"failed"
---@field since number [s] since when
---@field waiting? string what it is waiting for, and how long yet
---@field line? integer where it waits

---@class ProbeView
---@field value number|boolean|string|table
---@field tm number [s] when it was set
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

---@class Scenario
---@field seed integer of this run
---@field world World the components of the system, once there is one
---@field [string] Component the same
local s = {}

---Loads a system file and activates what it names. Its robots may differ by fields of a robot file.
---@param file string
---@param options? LoadOptions
---@return World
function s:load(file, options) end

---A recorded run as a world: its ports can be looked at while time moves through the recording. A journal, a recording
---of nezumi, or a recording of ROS 2 in MCAP.
---@param file string
---@param options? RecordedOptions
---@return World world
---@return number length [s] of the recording
function s:recorded(file, options) end

---Gives a behaviour what its component got in a recorded run. Fails where it writes something else than then.
---@param options JudgeOptions
function s:judge(options) end

---[s] Simulated time since the scenario began.
---@return number
function s:now() end

---Holds from here to the end, after every tick.
---@param name string
---@param condition Condition
---@overload fun(self: Scenario, name: string, options: ExpectationOptions, condition: Condition)
function s:always(name, condition) end

---Never holds, from here to the end.
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

---From here on this component may go to ERROR; else that fails the scenario.
---@param component Component|string
function s:allow_error(component) end

---Draws values for this run, each from a range or a list, from its seed. A search chooses them; a failing run is simplified.
---@param name string
---@param values table<string, any[]|Range>
---@return table<string, any>
function s:any(name, values) end

---Keeps one number of this run under a name: `nezumi test --measures FILE.csv` has a row for each run.
---@param name string
---@param value number finite
---@param unit? string
function s:measure(name, value, unit) end

---Records these ports from here on, after every tick, and compares with the committed file beside the scenario's.
---@param file string
---@param options GoldenOptions
---@param ... PortName
---@overload fun(self: Scenario, file: string, ...: PortName)
function s:golden(file, options, ...) end

---One message as from a connection.
---@param port PortName
---@param value any
function s:inject(port, value) end

---This value and nothing else, until `release`.
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

---Nothing gets through.
---@param port PortName
---@param seconds? number [s] without it until `restore`
function s:drop(port, seconds) end

---The present value again and again.
---@param port PortName
---@param seconds? number [s] without it until `restore`
function s:freeze(port, seconds) end

---A hand that moves the robot.
---@param robot Component|string
---@param velocities VelocityConstraintFields
function s:disturb(robot, velocities) end

---@param robot Component|string
---@param button string
---@param seconds? number [s] without it until `restore`
function s:press(robot, button, seconds) end

---A robot, at rest; or a marker of the arena by its name, where what is left out stays as it is.
---@param thing Component|string
---@param pose PoseFields|MarkerPoseFields
function s:teleport(thing, pose) end

---Emergency stop: every robot brakes as hard as it can and ignores commands, until `rearm`.
function s:stop() end

---Robots obey again what comes from now on. They must stand.
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
---@param fields MazeFields
---@return Thing
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

---This system is a host among others. Without the word nothing of it is on the network.
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

