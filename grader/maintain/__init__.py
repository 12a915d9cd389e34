"""For those who keep the kit: proof that trees, checks and bank still fit together."""
