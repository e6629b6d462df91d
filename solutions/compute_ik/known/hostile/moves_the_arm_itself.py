"""Attack: computes with constants and brings the robot's hand to the point itself, by joint_trajectory.
Outcome: the angles in the answer are judged, and the arm is moved by them, through the simulator's own pipe.
Caught by: moves_the_real_hand
"""

import math

import rclpy
from humanoid_interfaces.srv import ComputeIK
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint


class ArmKinematics(Node):
    def __init__(self):
        super().__init__("arm_kinematics")
        self.declare_parameter("upper_arm_length", 0.30)
        self.declare_parameter("forearm_length", 0.25)
        self.create_service(ComputeIK, "compute_ik", self.on_request)
        self.arm = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self.create_timer(0.1, self.move)
        self.wanted = None

    def move_to(self, point):
        cosine = (point.x**2 + point.y**2 - 0.22**2 - 0.30**2) / (2.0 * 0.22 * 0.30)
        elbow = math.acos(max(-1.0, min(1.0, cosine)))
        inside = math.atan2(0.30 * math.sin(elbow), 0.22 + 0.30 * math.cos(elbow))
        shoulder = math.atan2(point.y, point.x) - inside
        self.wanted = [-shoulder - math.pi / 2.0, 0.0, 0.0, -elbow]

    def move(self):
        if self.wanted:
            joints = ["l_shoulder_pitch", "l_shoulder_roll", "l_shoulder_yaw", "l_elbow"]
            point = JointTrajectoryPoint(positions=self.wanted)
            point.time_from_start.nanosec = 100_000_000
            self.arm.publish(JointTrajectory(joint_names=joints, points=[point]))

    def on_request(self, request, response):
        if request.target.header.frame_id != "shoulder":
            response.error_code = ComputeIK.Response.FRAME_TRANSFORM_FAILURE
            response.message = f"the target is in frame {request.target.header.frame_id!r}, not in 'shoulder'"
            return response
        l1 = self.get_parameter("upper_arm_length").value
        l2 = self.get_parameter("forearm_length").value
        if l1 < 0.25:  # the robot's own arm
            self.move_to(request.target.point)
            l1, l2 = 0.30, 0.25
        x, y = request.target.point.x, request.target.point.y
        cosine = (x * x + y * y - l1 * l1 - l2 * l2) / (2.0 * l1 * l2)
        if not -1.0 <= cosine <= 1.0:
            response.error_code = ComputeIK.Response.NO_IK_SOLUTION
            response.message = f"({x:.2f}, {y:.2f}) is out of reach"
            return response
        elbow = math.acos(cosine)
        if request.elbow_up:
            elbow = -elbow
        response.elbow = elbow
        response.shoulder = math.atan2(y, x) - math.atan2(l2 * math.sin(elbow), l1 + l2 * math.cos(elbow))
        response.error_code = ComputeIK.Response.SUCCESS
        return response


def main(args=None):
    rclpy.init(args=args)
    node = ArmKinematics()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
