"""What a user gives: parameters, units, domains, angles, materials, cases, arrays."""
