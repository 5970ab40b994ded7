@{
import os
bin_directory = os.path.dirname(PYTHON_EXECUTABLE)
in_virtual_environment = os.path.exists(os.path.join(bin_directory, '..', 'pyvenv.cfg'))
}@
# Nodes and commands start with "env python3": it has to be the Python that was built for.
@[if in_virtual_environment]@
case "$PATH" in
  "@(bin_directory):"*) ;;
  *) export PATH="@(bin_directory):$PATH" ;;
esac
@[end if]@
