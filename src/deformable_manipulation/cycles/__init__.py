"""How a node's messages go together cycle by cycle, and how it fares."""
