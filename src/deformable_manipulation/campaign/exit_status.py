"""How a campaign ends, for the shell."""

UNACCEPTABLE = 3  # the campaign was done, and something in it went wrong
