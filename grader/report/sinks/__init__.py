"""Write a result in the forms of other systems; each module has one form."""
