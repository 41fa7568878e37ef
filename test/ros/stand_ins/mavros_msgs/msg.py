"""MAVROS's CompanionProcessStatus, reduced to the constants that are used."""
from genpy.dynamic import generate_dynamic
from std_msgs.msg import Header

TEXT = f"""std_msgs/Header header
uint8 state
uint8 component
uint8 MAV_STATE_BOOT = 1
uint8 MAV_STATE_STANDBY = 3
uint8 MAV_STATE_ACTIVE = 4
uint8 MAV_STATE_CRITICAL = 5
uint8 MAV_COMP_ID_USER1 = 25
{80 * '='}
MSG: std_msgs/Header
{Header._full_text}"""
CompanionProcessStatus = generate_dynamic("mavros_msgs/CompanionProcessStatus", TEXT)["mavros_msgs/CompanionProcessStatus"]
