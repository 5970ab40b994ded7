"""ROS adapters: messages to and from the core's arrays, and what the nodes have in common."""
