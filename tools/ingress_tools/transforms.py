"""Rotations, and transforms as messages without the Python package of tf2_msgs, which need not be installed."""
import numpy


def transforms_type():
    """tf2_msgs/TFMessage, made from its definition."""
    from genpy.dynamic import generate_dynamic  # pylint: disable=import-outside-toplevel
    from geometry_msgs.msg import TransformStamped  # pylint: disable=import-outside-toplevel
    text = ("geometry_msgs/TransformStamped[] transforms\n" + "=" * 80 + "\nMSG: geometry_msgs/TransformStamped\n"
            + TransformStamped._full_text)
    return generate_dynamic("tf2_msgs/TFMessage", text)["tf2_msgs/TFMessage"]


def matrix_of(quaternion):
    """Rotation of (x, y, z, w)."""
    x, y, z, w = numpy.asarray(quaternion, float) / numpy.linalg.norm(quaternion)
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def rotation_of(message):
    """Rotation of a geometry_msgs/Quaternion."""
    return matrix_of([message.x, message.y, message.z, message.w])


def quaternion_of(matrix):
    """(x, y, z, w) of a rotation."""
    k = numpy.array([[matrix[0, 0] - matrix[1, 1] - matrix[2, 2], 0.0, 0.0, 0.0],
                     [matrix[0, 1] + matrix[1, 0], matrix[1, 1] - matrix[0, 0] - matrix[2, 2], 0.0, 0.0],
                     [matrix[0, 2] + matrix[2, 0], matrix[1, 2] + matrix[2, 1], matrix[2, 2] - matrix[0, 0] - matrix[1, 1], 0.0],
                     [matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1], numpy.trace(matrix)]])
    values, vectors = numpy.linalg.eigh(k / 3.0)
    return vectors[:, numpy.argmax(values)]
