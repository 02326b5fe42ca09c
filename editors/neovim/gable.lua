-- Put this file into ~/.config/nvim/lua and write require('gable') into init.lua.
vim.filetype.add({ extension = {
  cga = 'cga', gbbg = 'gbbg', park = 'park', grammar = 'progen3d', pg3d = 'progen3d' } })
local types, markers = { 'cga', 'gbbg', 'park', 'progen3d' }, { 'rules', 'assets', '.git' }
if vim.lsp.config then -- 0.11 or newer
  vim.lsp.config('gable', { cmd = { 'gable', 'lsp' }, filetypes = types, root_markers = markers })
  vim.lsp.enable('gable')
else -- 0.8 to 0.10
  vim.api.nvim_create_autocmd('FileType', { pattern = types, callback = function(event)
    local path = vim.api.nvim_buf_get_name(event.buf)
    local found = vim.fs.find(markers, { path = path, upward = true })[1]
    vim.lsp.start({ name = 'gable', cmd = { 'gable', 'lsp' }, root_dir = vim.fs.dirname(found) })
  end })
end
