"""Write the forms that other systems read: a function each, from one result, every word escaped."""
